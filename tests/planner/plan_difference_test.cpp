// SPDX-License-Identifier: Apache-2.0
#include "planner/plan_difference.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>

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

TEST(PlanDifferenceTest, AnotherNumberOfContactsIsDifferent) {
  EXPECT_TRUE(differentPaths(planAlong({{0, 0}, {1, 0}}), planAlong({{0, 0}, {1, 0}, {1, 0}})));
  EXPECT_FALSE(differentPaths(Plan{}, Plan{}));
}

}  // namespace
}  // namespace ifa
