// SPDX-License-Identifier: Apache-2.0
// Starts with a tetrahedron and the corners that reach furthest in evenly spread directions, and
// adds, round by round, the corner that lies furthest outside each triangle, the furthest first,
// until there are enough.
#include "body/simple_hull.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/parallel.h"
#include "body/convex_hull.h"
#include "body/qhull.h"

namespace ifa {

using Eigen::Vector3d;

namespace {

// Decision: what is further off is another shape. A sphere, the worst case, stays well under it.
constexpr double kLargestDeviation = 0.005;  // of the size

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Where a corner lies relative to the simple hull.
struct Outside {
  double distance = 0;           ///< m; 0 inside
  std::size_t triangle = kNone;  ///< the nearest; none inside
};

double distanceFromSegment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double share = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0;
  return (a + share * along - p).norm();
}

/// The surface of the hull of some of the corners.
class Surface {
 public:
  Surface(const std::vector<Vector3d>& points, const std::vector<HullTriangle>& triangles)
      : normals_(static_cast<Eigen::Index>(triangles.size()), 3),
        offsets_(static_cast<Eigen::Index>(triangles.size())) {
    for (const HullTriangle& triangle : triangles) {
      const auto row = static_cast<Eigen::Index>(triangles_.size());
      auto& [a, b, c] = triangles_.emplace_back();
      a = points[static_cast<std::size_t>(triangle.points[0])];
      b = points[static_cast<std::size_t>(triangle.points[1])];
      c = points[static_cast<std::size_t>(triangle.points[2])];
      normals_.row(row) = triangle.outward.transpose();
      offsets_[row] = triangle.outward.dot(a);
    }
  }

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

  // The nearest point of a convex surface lies in a triangle that is seen from outside.
  [[nodiscard]] Outside outside(const Vector3d& p) const {
    Outside nearest;
    const Eigen::VectorXd heights = normals_ * p - offsets_;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const double height = heights[static_cast<Eigen::Index>(i)];
      if (!(height > 0) || (nearest.triangle != kNone && height >= nearest.distance)) continue;
      const double distance = distanceFrom(i, p, height);
      if (nearest.triangle == kNone || distance < nearest.distance) nearest = {distance, i};
    }
    return nearest;
  }

 private:
  using Triangle = std::array<Vector3d, 3>;

  [[nodiscard]] double distanceFrom(std::size_t i, const Vector3d& p, double height) const {
    const auto& [a, b, c] = triangles_[i];
    const Vector3d normal = (b - a).cross(c - a);
    const auto within = [&](const Vector3d& from, const Vector3d& to) {
      return normal.dot((to - from).cross(p - from)) >= 0;
    };
    if (normal.squaredNorm() > 0 && within(a, b) && within(b, c) && within(c, a)) return height;
    return std::min(
        {distanceFromSegment(p, a, b), distanceFromSegment(p, b, c), distanceFromSegment(p, c, a)});
  }

  std::vector<Triangle> triangles_;
  Eigen::MatrixX3d normals_;
  Eigen::VectorXd offsets_;
};

template <class Measure>
std::size_t furthest(const std::vector<Vector3d>& corners, Measure measure) {
  std::size_t best = 0;
  double most = -HUGE_VAL;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double value = measure(corners[i]);
    if (value > most) most = value, best = i;
  }
  return best;
}

// Corners that span as much as four can.
std::vector<std::size_t> tetrahedron(const std::vector<Vector3d>& corners) {
  const std::size_t first = furthest(corners, [](const Vector3d& p) { return p.x(); });
  const Vector3d& a = corners[first];
  const std::size_t second =
      furthest(corners, [&](const Vector3d& p) { return (p - a).squaredNorm(); });
  const Vector3d& b = corners[second];
  const std::size_t third =
      furthest(corners, [&](const Vector3d& p) { return (b - a).cross(p - a).squaredNorm(); });
  const Vector3d normal = (b - a).cross(corners[third] - a);
  const std::size_t fourth =
      furthest(corners, [&](const Vector3d& p) { return std::abs(normal.dot(p - a)); });
  return {first, second, third, fourth};
}

// The corners that reach furthest in directions that are spread evenly.
std::vector<std::size_t> extremes(const std::vector<Vector3d>& corners, std::size_t directions) {
  constexpr double kGoldenAngle = 2.39996322972865332;
  std::vector<std::size_t> found(directions);
  parallelFor(directions, [&](std::size_t i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(directions);
    const double r = std::sqrt(1 - z * z), angle = kGoldenAngle * static_cast<double>(i);
    const Vector3d direction(r * std::cos(angle), r * std::sin(angle), z);
    found[i] = furthest(corners, [&](const Vector3d& p) { return direction.dot(p); });
  });
  return found;
}

// Corners to start with: the tetrahedron makes sure that they span a volume, the others that a
// round body is cut alike all round.
std::vector<std::size_t> firstCorners(const std::vector<Vector3d>& corners, std::size_t most) {
  std::vector<std::size_t> chosen = tetrahedron(corners);
  const auto even = extremes(corners, (most - chosen.size()) * 7 / 8);
  chosen.insert(chosen.end(), even.begin(), even.end());
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::vector<Vector3d> taken(const std::vector<Vector3d>& corners,
                            const std::vector<std::size_t>& chosen) {
  std::vector<Vector3d> some;
  some.reserve(chosen.size());
  for (const std::size_t i : chosen) some.push_back(corners[i]);
  return some;
}

/// Where every corner lies relative to the hull of the chosen ones. Nothing where that is flat.
std::optional<std::vector<Outside>> measured(const std::vector<Vector3d>& corners,
                                             const std::vector<std::size_t>& chosen) {
  const std::vector<Vector3d> some = taken(corners, chosen);
  const auto triangles = hullTriangles(some);
  if (!triangles) return std::nullopt;
  const Surface surface(some, *triangles);
  std::vector<Outside> outside(corners.size());
  parallelFor(corners.size(), [&](std::size_t i) { outside[i] = surface.outside(corners[i]); });
  for (const std::size_t i : chosen) outside[i] = {};  // rounding puts some a hair outside
  return outside;
}

/// The corner furthest outside each triangle, the furthest of all first.
std::vector<std::size_t> candidates(const std::vector<Outside>& outside) {
  std::map<std::size_t, std::size_t> furthestOf;  // by triangle
  for (std::size_t i = 0; i < outside.size(); ++i) {
    if (outside[i].triangle == kNone) continue;
    std::size_t& best = furthestOf.try_emplace(outside[i].triangle, i).first->second;
    if (outside[i].distance > outside[best].distance) best = i;
  }
  std::vector<std::size_t> order;
  order.reserve(furthestOf.size());
  for (const auto& entry : furthestOf) order.push_back(entry.second);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double first = outside[a].distance, second = outside[b].distance;
    return first > second || (first == second && a < b);
  });
  return order;
}

}  // namespace

Result<SimpleHull> simplifiedHull(const std::vector<Vector3d>& corners, std::size_t most) {
  if (corners.size() <= most) return SimpleHull{corners, corners.size(), 0};
  std::vector<std::size_t> chosen = firstCorners(corners, most);
  for (;;) {
    const auto outside = measured(corners, chosen);
    if (!outside) return badInput("all vertices lie in one plane, or nearly");
    std::vector<std::size_t> next = candidates(*outside);
    if (chosen.size() >= most || next.empty()) {
      std::sort(chosen.begin(), chosen.end());
      const double deviation = next.empty() ? 0 : (*outside)[next.front()].distance;
      return SimpleHull{taken(corners, chosen), corners.size(), deviation};
    }
    // Fewer at once would be a little better and slower.
    const std::size_t room = std::min(most - chosen.size(), 1 + chosen.size() / 16);
    next.resize(std::min(next.size(), room));
    chosen.insert(chosen.end(), next.begin(), next.end());
  }
}

Result<SimpleHull> hullForPhysics(const std::vector<Vector3d>& points) {
  const auto exact = convexHull(points);
  if (!exact) return tl::unexpected(exact.error());
  auto simple = simplifiedHull(*exact, kMostHullVertices);
  if (!simple) return simple;
  Eigen::AlignedBox3d box;
  for (const Vector3d& corner : *exact) box.extend(corner);
  if (simple->deviation <= kLargestDeviation * box.sizes().maxCoeff()) return simple;
  return badInput(
      fmt::format("its convex hull has {} vertices, and one of {} would be {:.2g} mm off",
                  exact->size(), kMostHullVertices, 1e3 * simple->deviation),
      {}, "simplify the mesh");
}

}  // namespace ifa
