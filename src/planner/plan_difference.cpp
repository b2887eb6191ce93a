// SPDX-License-Identifier: Apache-2.0
#include "planner/plan_difference.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kCosine = 0.93969262078590838;  ///< of 20 degrees

double lengthOf(const Points& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

Points centred(Points points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  for (Vector2d& p : points) p -= mean;
  return points;
}

/// A turn of the plane.
struct Turn {
  double c = 1, s = 0;  ///< cosine and sine
};

Turn turnAlong(double along, double across) {
  const double size = std::hypot(along, across);
  return size > 0 ? Turn{along / size, across / size} : Turn{};
}

/// The turn that lays centred path `b` onto `a` by least squares.
Turn turnOnto(const Points& a, const Points& b) {
  double along = 0, across = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    along += a[i].dot(b[i]);
    across += b[i].x() * a[i].y() - b[i].y() * a[i].x();
  }
  return turnAlong(along, across);
}

/// The turn about the vertical that leaves the smallest angle between two poses.
Turn turnOnto(const Matrix3d& a, const Matrix3d& b) {
  const Matrix3d r = a * b.transpose();
  return turnAlong(r(0, 0) + r(1, 1), r(1, 0) - r(0, 1));
}

/// Largest distance between two centred paths once `b` is turned.
double farthestApart(const Points& a, const Points& b, const Turn& turn) {
  double apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d turned(turn.c * b[i].x() - turn.s * b[i].y(),
                          turn.s * b[i].x() + turn.c * b[i].y());
    apart = std::max(apart, (a[i] - turned).norm());
  }
  return apart;
}

bool nearlySamePose(const Matrix3d& a, const Matrix3d& b, const Turn& turn) {
  Matrix3d about;
  about << turn.c, -turn.s, 0, turn.s, turn.c, 0, 0, 0, 1;
  const double cosine = 0.5 * ((a.transpose() * about * b).trace() - 1);
  return cosine >= kCosine;
}

Matrix3d finalPose(const Plan& plan) {
  const PlannedContact& last = plan.contacts.back();
  return last.placement.apply(last.event.after).orientation.toRotationMatrix();
}

Points mirrored(Points points) {
  for (Vector2d& p : points) p.y() = -p.y();
  return points;
}

/// Both paths, centred, and how far they may lie apart.
struct Pair {
  Points a, b;
  double most = 0;
  [[nodiscard]] bool near(const Turn& turn) const { return farthestApart(a, b, turn) <= most; }
};

Pair pairOf(Points a, Points b) {
  const double length = std::max(lengthOf(a), lengthOf(b));
  return {centred(std::move(a)), centred(std::move(b)), kDifferentShare * length};
}

/// Whether the second motion, its final pose given as one of those that look alike, is the first.
bool sameTake(const Pair& paths, const Turn& byPaths, bool nearByPaths, const Matrix3d& pose,
              const Matrix3d& other) {
  if (nearByPaths && nearlySamePose(pose, other, byPaths)) return true;
  const Turn byPoses = turnOnto(pose, other);
  return nearlySamePose(pose, other, byPoses) && paths.near(byPoses);
}

}  // namespace

std::vector<Vector2d> pathOf(const Plan& plan) {
  std::vector<Vector2d> points;
  for (const PlannedContact& contact : plan.contacts) {
    points.push_back(contact.placement.apply(contact.event.before).position.head<2>());
  }
  if (!plan.contacts.empty()) {
    const PlannedContact& last = plan.contacts.back();
    points.push_back(last.placement.apply(last.event.after).position.head<2>());
  }
  return points;
}

bool differentPaths(std::vector<Vector2d> a, std::vector<Vector2d> b) {
  if (a.size() != b.size()) return true;
  if (a.empty()) return false;
  Pair pair = pairOf(std::move(a), std::move(b));
  if (pair.near(turnOnto(pair.a, pair.b))) return false;
  pair.b = mirrored(std::move(pair.b));
  return !pair.near(turnOnto(pair.a, pair.b));
}

bool differentPaths(const Plan& a, const Plan& b) { return differentPaths(pathOf(a), pathOf(b)); }

bool differentTakes(const Plan& a, const Plan& b, std::span<const Matrix3d> group) {
  if (a.contacts.size() != b.contacts.size()) return true;
  if (a.contacts.empty()) return false;
  static const std::array<Matrix3d, 1> kNone = {Matrix3d::Identity()};
  if (group.empty()) group = kNone;
  const Pair straight = pairOf(pathOf(a), pathOf(b));
  const Pair mirror = {straight.a, mirrored(straight.b), straight.most};
  const Turn turn = turnOnto(straight.a, straight.b), mirrorTurn = turnOnto(mirror.a, mirror.b);
  const bool near = straight.near(turn), nearMirrored = mirror.near(mirrorTurn);
  const Matrix3d pose = finalPose(a), other = finalPose(b);
  const Matrix3d across = Eigen::Vector3d(1, -1, 1).asDiagonal();
  return std::none_of(group.begin(), group.end(), [&](const Matrix3d& element) {
    // An improper element and the mirror together make a rotation again.
    if (element.determinant() > 0) return sameTake(straight, turn, near, pose, other * element);
    return sameTake(mirror, mirrorTurn, nearMirrored, pose, across * other * element);
  });
}

}  // namespace ifa
