// SPDX-License-Identifier: Apache-2.0
#include "body/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "body/qhull.h"

namespace ifa {

using Eigen::Vector3d;

namespace {

/// How far a corner stands out beyond its neighbours in direction `direction` (not zero), m.
double marginAlong(const Vector3d& direction, const std::vector<Vector3d>& toNeighbours) {
  double margin = HUGE_VAL;
  const double length = direction.norm();
  for (const Vector3d& d : toNeighbours) margin = std::min(margin, -d.dot(direction) / length);
  return margin;
}

// The distance of a corner from the hull of its neighbours is the largest margin over all
// directions, and the direction that gives it is square to a triangle, an edge or a point of that
// hull.
bool standsOut(const std::vector<Vector3d>& toNeighbours, double tolerance) {
  const auto good = [&](const Vector3d& direction) {
    return direction.squaredNorm() > 0 && marginAlong(direction, toNeighbours) > tolerance;
  };
  const std::size_t count = toNeighbours.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d& a = toNeighbours[i];
    if (good(-a)) return true;
    for (std::size_t j = 0; j < i; ++j) {
      const Vector3d edge = toNeighbours[j] - a;
      const double squared = edge.squaredNorm();
      if (squared > 0 && good(edge * (a.dot(edge) / squared) - a)) return true;
      for (std::size_t k = 0; k < j; ++k) {
        const Vector3d normal = edge.cross(toNeighbours[k] - a);
        if (good(normal) || good(-normal)) return true;
      }
    }
  }
  return false;
}

bool isTrueCorner(const HullCorner& corner, const std::vector<Vector3d>& points, double tolerance) {
  std::vector<Vector3d> toNeighbours;
  for (int neighbour : corner.neighbours) {
    toNeighbours.push_back(points[static_cast<std::size_t>(neighbour)] -
                           points[static_cast<std::size_t>(corner.point)]);
  }
  if (corner.outward.squaredNorm() > 0 && marginAlong(corner.outward, toNeighbours) > tolerance) {
    return true;
  }
  // The full search grows with the fourth power; a corner kept without need does no harm.
  constexpr std::size_t kMostForFullSearch = 40;
  return toNeighbours.size() > kMostForFullSearch || standsOut(toNeighbours, tolerance);
}

// One round of leaving out corners, no two of which are neighbours: two that lie close together
// would otherwise each be left out because of the other.
std::vector<Vector3d> withoutFlatCorners(const std::vector<HullCorner>& corners,
                                         const std::vector<Vector3d>& points, double tolerance) {
  std::vector<char> locked(points.size(), 0);
  std::vector<Vector3d> kept;
  for (const HullCorner& corner : corners) {
    const auto self = static_cast<std::size_t>(corner.point);
    if (locked[self] != 0 || isTrueCorner(corner, points, tolerance)) {
      kept.push_back(points[self]);
    } else {
      for (int neighbour : corner.neighbours) locked[static_cast<std::size_t>(neighbour)] = 1;
    }
  }
  return kept;
}

}  // namespace

Result<std::vector<Vector3d>> convexHull(const std::vector<Vector3d>& points,
                                         double relativeTolerance) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) {
    if (!p.allFinite()) return badInput("a vertex is not a finite number");
    box.extend(p);
  }
  const double size = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  const auto flat = [] {
    return badInput("all vertices lie in one plane, or nearly", {}, "give the body a thickness");
  };
  if (points.size() < 4 || !(size > 0)) return flat();
  std::vector<Vector3d> remaining = points;
  for (;;) {
    const auto corners = hullCorners(remaining);
    if (!corners) return flat();
    std::vector<Vector3d> kept = withoutFlatCorners(*corners, remaining, relativeTolerance * size);
    if (kept.size() < 4) return flat();
    // Rounds cost seconds on a hull of many thousands, where a corner too many does not matter.
    constexpr std::size_t kFewEnoughForRounds = 10'000;
    if (kept.size() == corners->size() || kept.size() > kFewEnoughForRounds) return kept;
    remaining = std::move(kept);
  }
}

}  // namespace ifa
