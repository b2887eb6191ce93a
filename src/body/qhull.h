// SPDX-License-Identifier: Apache-2.0
// What the library qhull finds out about the convex hull of points, as plain data.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace ifa {

/// A corner of the hull, the corners that share a facet with it, and the sum of those facets'
/// outward normals. Points are indices into the points that were given.
struct HullCorner {
  int point = 0;
  std::vector<int> neighbours;
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
};

/// A triangle of the hull's surface and the unit normal of the facet that it lies in.
struct HullTriangle {
  std::array<int, 3> points = {};
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();
};

/// Corners of the hull, in the order of `points`. Nothing where the points lie in one plane, or
/// nearly.
[[nodiscard]] std::optional<std::vector<HullCorner>> hullCorners(
    const std::vector<Eigen::Vector3d>& points);

/// The hull's surface. Nothing where the points lie in one plane, or nearly.
[[nodiscard]] std::optional<std::vector<HullTriangle>> hullTriangles(
    const std::vector<Eigen::Vector3d>& points);

}  // namespace ifa
