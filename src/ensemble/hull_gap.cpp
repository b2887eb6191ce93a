// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hull_gap.h"

#include <algorithm>
#include <array>
#include <limits>

namespace ifa {

namespace {

using Eigen::Vector3d;

constexpr double kExact = 1e-5;  // m
constexpr int kMostSteps = 64;

/// Points of the difference of two hulls, at most four, and the place in their hull that is nearest
/// to the origin.
struct Simplex {
  std::array<Vector3d, 4> points = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(),
                                    Vector3d::Zero()};
  int count = 0;
  Vector3d nearest = Vector3d::Zero();

  void keep(std::initializer_list<int> which) {
    const std::array<Vector3d, 4> all = points;
    count = 0;
    for (const int i : which) {
      points[static_cast<std::size_t>(count++)] = all[static_cast<std::size_t>(i)];
    }
  }
  [[nodiscard]] const Vector3d& at(int i) const { return points[static_cast<std::size_t>(i)]; }
};

Simplex nearestOnSegment(Simplex s) {
  const Vector3d along = s.at(1) - s.at(0);
  const double length = along.squaredNorm();
  const double t = length > 0 ? -s.at(0).dot(along) / length : 0;
  if (t <= 0) {
    s.nearest = s.at(0);
    s.keep({0});
  } else if (t >= 1) {
    s.nearest = s.at(1);
    s.keep({1});
  } else {
    s.nearest = s.at(0) + t * along;
  }
  return s;
}

Simplex faceOf(const Simplex& s, std::initializer_list<int> which) {
  Simplex face = s;
  face.keep(which);
  return face;
}

template <class Nearest>
Simplex bestOf(const Simplex& s, std::initializer_list<std::initializer_list<int>> faces,
               const Nearest& nearestOn) {
  Simplex best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& which : faces) {
    const Simplex found = nearestOn(faceOf(s, which));
    if (const double square = found.nearest.squaredNorm(); square < least) {
      least = square;
      best = found;
    }
  }
  return best;
}

/// The foot of the perpendicular where it lies in the triangle, else the best of its sides.
Simplex nearestOnTriangle(Simplex s) {
  const Vector3d ab = s.at(1) - s.at(0), ac = s.at(2) - s.at(0), normal = ab.cross(ac);
  const double square = normal.squaredNorm();
  if (square > 1e-30) {
    const Vector3d foot = normal * (s.at(0).dot(normal) / square);
    const Vector3d from = foot - s.at(0);
    const double v = from.cross(ac).dot(normal) / square, w = ab.cross(from).dot(normal) / square;
    if (v >= 0 && w >= 0 && v + w <= 1) {
      s.nearest = foot;
      return s;
    }
  }
  return bestOf(s, {{0, 1}, {0, 2}, {1, 2}}, nearestOnSegment);
}

/// Nothing is left to look for where the origin lies within: nearest is 0.
Simplex nearestOnTetrahedron(const Simplex& s) {
  const auto sameSide = [&](int a, int b, int c, int opposite) {
    const Vector3d normal = (s.at(b) - s.at(a)).cross(s.at(c) - s.at(a));
    return normal.dot(s.at(opposite) - s.at(a)) * normal.dot(-s.at(a)) > 0;
  };
  if (sameSide(0, 1, 2, 3) && sameSide(0, 1, 3, 2) && sameSide(0, 2, 3, 1) &&
      sameSide(1, 2, 3, 0)) {
    Simplex inside = s;
    inside.nearest.setZero();
    return inside;
  }
  return bestOf(s, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}, nearestOnTriangle);
}

Simplex nearestOn(const Simplex& s) {
  if (s.count == 2) return nearestOnSegment(s);
  if (s.count == 3) return nearestOnTriangle(s);
  return nearestOnTetrahedron(s);
}

/// The corner that lies furthest along `direction`, world frame.
Vector3d furthest(const Hull& hull, const Pose& pose, const Vector3d& direction) {
  const Vector3d inBody = pose.orientation.conjugate() * direction;
  const auto corner = std::max_element(
      hull.corners->begin(), hull.corners->end(),
      [&](const Vector3d& a, const Vector3d& b) { return a.dot(inBody) < b.dot(inBody); });
  return pose.position + pose.orientation * *corner;
}

}  // namespace

double hullGap(const Hull& one, const Pose& onePose, const Hull& other, const Pose& otherPose,
               double enough) {
  const Vector3d between = onePose.position - otherPose.position;
  const double balls = between.norm() - one.radius - other.radius;
  if (balls >= enough) return balls;
  const auto support = [&](const Vector3d& direction) -> Vector3d {
    return furthest(one, onePose, -direction) - furthest(other, otherPose, direction);
  };
  Simplex simplex;
  simplex.points[0] = simplex.nearest = support(between);
  simplex.count = 1;
  double bound = std::max(0.0, balls);
  for (int step = 0; step < kMostSteps; ++step) {
    const double distance = simplex.nearest.norm();
    if (distance < kExact) return 0;
    const Vector3d point = support(simplex.nearest);
    bound = std::max(bound, point.dot(simplex.nearest) / distance);
    if (bound >= enough || distance - bound < kExact || simplex.count == 4) return bound;
    simplex.points[static_cast<std::size_t>(simplex.count++)] = point;
    simplex = nearestOn(simplex);
  }
  return bound;
}

}  // namespace ifa
