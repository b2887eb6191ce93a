// SPDX-License-Identifier: Apache-2.0
#include "planner/plan_difference.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>

namespace ifa {
namespace {

using Eigen::Vector2d;

Plan planAlong(const std::vector<Vector2d>& points) {
  Plan plan;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    PlannedContact contact;
    contact.event.before.position.head<2>() = points[i];
    contact.event.after.position.head<2>() = points[i + 1];
    plan.contacts.push_back(contact);
  }
  return plan;
}

double lengthOf(const std::vector<Vector2d>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

std::vector<Vector2d> anyPath() {
  const auto count = *rc::gen::inRange<std::size_t>(2, 12);
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(*rc::gen::inRange(-500, 500) / 1000.0,
                        *rc::gen::inRange(-500, 500) / 1000.0);
  }
  return points;
}

TEST(PlanDifferenceTest, MovedTurnedAndMirroredPathsAreTheSame) {
  EXPECT_TRUE(rc::check("a path is no different take from its own image", [] {
    const auto path = anyPath();
    RC_PRE(lengthOf(path) > 0.01);
    const Eigen::Rotation2Dd turn(*rc::gen::inRange(-314, 314) / 100.0);
    const Vector2d shift(*rc::gen::inRange(-900, 900) / 100.0, 0.7);
    const double side = *rc::gen::element(-1.0, 1.0);
    std::vector<Vector2d> image;
    for (const Vector2d& p : path) image.push_back(turn * Vector2d(p.x(), side * p.y()) + shift);
    RC_ASSERT(!differentPaths(planAlong(path), planAlong(image)));
    RC_ASSERT(!differentPaths(planAlong(image), planAlong(path)));
  }));
}

TEST(PlanDifferenceTest, AContactATenthOfThePathAwayMakesADifference) {
  // Straight on for a metre, then aside at the end: the ends lie 0.2 x 2 / 3 and more apart.
  const std::vector<Vector2d> straight = {{0, 0}, {0.5, 0}, {1, 0}};
  const std::vector<Vector2d> bent = {{0, 0}, {0.5, 0}, {0.7, 0.45}};
  const std::vector<Vector2d> nearly = {{0, 0}, {0.5, 0.01}, {1, 0.03}};
  EXPECT_TRUE(differentPaths(planAlong(straight), planAlong(bent)));
  EXPECT_FALSE(differentPaths(planAlong(straight), planAlong(nearly)));
}

TEST(PlanDifferenceTest, LongerStridesAreDifferent) {
  EXPECT_TRUE(rc::check("a path and itself twice as large", [] {
    auto path = anyPath();
    // One mean far from the ends, so that doubling moves some contact by over a tenth.
    std::vector<Vector2d> straight, twice;
    for (std::size_t i = 0; i < path.size(); ++i) {
      straight.emplace_back(0.1 * static_cast<double>(i), 0);
      twice.push_back(2 * straight.back());
    }
    RC_ASSERT(differentPaths(planAlong(straight), planAlong(twice)));
  }));
}

TEST(PlanDifferenceTest, AnotherOrderOfTurnsIsDifferentUnlessMirrored) {
  const std::vector<Vector2d> left = {{0, 0}, {1, 0}, {1, 1}, {2, 1}};
  const std::vector<Vector2d> right = {{0, 0}, {1, 0}, {1, -1}, {2, -1}};
  const std::vector<Vector2d> hook = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_FALSE(differentPaths(planAlong(left), planAlong(right)));
  EXPECT_TRUE(differentPaths(planAlong(left), planAlong(hook)));
}

constexpr double kDegree = std::numbers::pi / 180;

Plan planAlong(const std::vector<Vector2d>& points, const Eigen::Matrix3d& finalPose) {
  Plan plan = planAlong(points);
  plan.contacts.back().event.after.orientation = Eigen::Quaterniond(finalPose);
  return plan;
}

/// The 48 maps of a cube onto itself: signed permutations of the axes.
std::vector<Eigen::Matrix3d> cubeGroup() {
  std::vector<Eigen::Matrix3d> group;
  std::array<int, 3> axes = {0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
      for (int i = 0; i < 3; ++i) m(axes[static_cast<std::size_t>(i)], i) = signs >> i & 1 ? -1 : 1;
      group.push_back(m);
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return group;
}

std::vector<Eigen::Matrix3d> rotationsOf(std::vector<Eigen::Matrix3d> group) {
  std::erase_if(group, [](const Eigen::Matrix3d& m) { return m.determinant() < 0; });
  return group;
}

Eigen::Matrix3d anyPose() {
  const auto number = [] { return *rc::gen::inRange(-100, 100) / 100.0; };
  const Eigen::Vector4d q(number(), number(), number(), number() + 2);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

Eigen::Matrix3d aboutVertical(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Eigen::Matrix3d tilted(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(0.6, 0.8, 0)).toRotationMatrix();
}

/// A path that no turn or mirror lays over itself.
const std::vector<Vector2d> kHook = {{0, 0}, {0.1, 0}, {0.2, 0.05}, {0.2, 0.2}};

TEST(DifferentTakesTest, TheSameMotionMovedTurnedMirroredOrRelabelledIsTheSame) {
  EXPECT_TRUE(rc::check("an image under the plane's motions and the group is no other take", [] {
    const auto path = anyPath();
    RC_PRE(lengthOf(path) > 0.01);
    const Eigen::Matrix3d pose = anyPose();
    const double angle = *rc::gen::inRange(-314, 314) / 100.0;
    const Eigen::Matrix3d element = *rc::gen::elementOf(cubeGroup());
    // An improper element belongs to the mirrored world.
    const double side = element.determinant() > 0 ? 1 : -1;
    const Eigen::Matrix3d world =
        aboutVertical(angle) * Eigen::Vector3d(1, side, 1).asDiagonal().toDenseMatrix();
    std::vector<Vector2d> image;
    for (const Vector2d& p : path) {
      image.push_back((world * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>() + Vector2d(3, -0.4));
    }
    const Plan one = planAlong(path, pose), other = planAlong(image, world * pose * element);
    RC_ASSERT(!differentTakes(one, other, cubeGroup()));
    RC_ASSERT(!differentTakes(other, one, cubeGroup()));
  }));
}

TEST(DifferentTakesTest, RelabelledFacesAreDifferentWithoutTheGroup) {
  const Plan one = planAlong(kHook, Eigen::Matrix3d::Identity());
  const Plan other = planAlong(kHook, tilted(0) * rotationsOf(cubeGroup())[1]);
  EXPECT_TRUE(differentTakes(one, other));
  EXPECT_FALSE(differentTakes(one, other, cubeGroup()));
  EXPECT_FALSE(differentTakes(one, one));
}

TEST(DifferentTakesTest, AMirrorImageIsAnotherTakeOfABodyThatHasNoMirror) {
  std::vector<Vector2d> mirrored;
  for (const Vector2d& p : kHook) mirrored.emplace_back(p.x(), -p.y());
  const Eigen::Matrix3d pose = Eigen::Matrix3d::Identity();
  const Plan one = planAlong(kHook, pose), other = planAlong(mirrored, pose);
  EXPECT_FALSE(differentPaths(one, other));
  EXPECT_FALSE(differentTakes(one, other, cubeGroup()));
  EXPECT_TRUE(differentTakes(one, other, rotationsOf(cubeGroup())));
}

TEST(DifferentTakesTest, FinalPosesMayDifferByTwentyDegrees) {
  EXPECT_TRUE(rc::check("tilts under 20 degrees are the same, over 20 are not", [] {
    const Eigen::Matrix3d pose = anyPose();
    const double degrees = *rc::gen::inRange(0, 45);
    RC_PRE(degrees != 20);
    const Plan one = planAlong(kHook, pose);
    const Plan other = planAlong(kHook, tilted(degrees * kDegree) * pose);
    RC_ASSERT(differentTakes(one, other, cubeGroup()) == (degrees > 20));
  }));
  // Turned about the vertical alone, the path says that it was no turn of the whole.
  const Plan one = planAlong(kHook, Eigen::Matrix3d::Identity());
  EXPECT_TRUE(differentTakes(one, planAlong(kHook, aboutVertical(40 * kDegree))));
  EXPECT_FALSE(differentTakes(one, planAlong(kHook, aboutVertical(15 * kDegree))));
}

TEST(DifferentTakesTest, PathsThatDifferAreDifferentWhateverThePose) {
  const std::vector<Vector2d> straight = {{0, 0}, {0.5, 0}, {1, 0}};
  const std::vector<Vector2d> bent = {{0, 0}, {0.5, 0}, {0.7, 0.45}};
  const Eigen::Matrix3d pose = tilted(0.3);
  EXPECT_TRUE(differentTakes(planAlong(straight, pose), planAlong(bent, pose), cubeGroup()));
}

/// Whether some turn, mirror and element lay one over the other, by trying.
bool someTurnFits(const std::vector<Vector2d>& a, const Eigen::Matrix3d& poseA,
                  const std::vector<Vector2d>& b, const Eigen::Matrix3d& poseB) {
  const auto centre = [](const std::vector<Vector2d>& points) {
    Vector2d sum = Vector2d::Zero();
    for (const Vector2d& p : points) sum += p;
    return Vector2d(sum / static_cast<double>(points.size()));
  };
  const double most = 0.1 * std::max(lengthOf(a), lengthOf(b));
  for (const Eigen::Matrix3d& element : cubeGroup()) {
    const double side = element.determinant() > 0 ? 1 : -1;
    for (int degrees = 0; degrees < 360; ++degrees) {
      const Eigen::Matrix3d world = aboutVertical(degrees * kDegree) *
                                    Eigen::Vector3d(1, side, 1).asDiagonal().toDenseMatrix();
      const double angle = Eigen::AngleAxisd(poseA.transpose() * world * poseB * element).angle();
      double apart = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const Vector2d p = b[i] - centre(b);
        const Vector2d turned = (world * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
        apart = std::max(apart, (a[i] - centre(a) - turned).norm());
      }
      // What is lost by whole degrees.
      if (angle < 21 * kDegree && apart < most + 0.01 * lengthOf(b)) return true;
    }
  }
  return false;
}

TEST(DifferentTakesTest, OnlyWhatSomeTurnLaysOverTheOtherIsTheSame) {
  EXPECT_TRUE(rc::check("the same takes are found to be so by trying all turns", [] {
    auto path = anyPath();
    RC_PRE(lengthOf(path) > 0.05);
    if (path.size() > 5) path.resize(5);
    std::vector<Vector2d> other;
    const double off = *rc::gen::inRange(0, 25) / 100.0 * lengthOf(path);
    for (std::size_t i = 0; i < path.size(); ++i) {
      other.push_back(path[i] + Vector2d(i % 2 == 0 ? off : 0, 0));
    }
    const Eigen::Matrix3d pose = anyPose();
    const Eigen::Matrix3d tilt = tilted(*rc::gen::inRange(0, 40) * kDegree) * pose;
    const bool same = !differentTakes(planAlong(path, pose), planAlong(other, tilt), cubeGroup());
    RC_ASSERT(!same || someTurnFits(path, pose, other, tilt));
  }));
}

TEST(PlanDifferenceTest, AnotherNumberOfContactsIsDifferent) {
  EXPECT_TRUE(differentPaths(planAlong({{0, 0}, {1, 0}}), planAlong({{0, 0}, {1, 0}, {1, 0}})));
  EXPECT_FALSE(differentPaths(Plan{}, Plan{}));
}

}  // namespace
}  // namespace ifa
