// SPDX-License-Identifier: Apache-2.0
// A convex hull of fewer corners, for meshes whose own has too many to simulate.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ifa/result.h"

namespace ifa {

/// Most vertices of a hull that is simulated: a simulation walks over all of them at every step.
inline constexpr std::size_t kMostHullVertices = 512;

/// Some corners of a convex hull, and how far the hull of those falls short of the whole.
struct SimpleHull {
  std::vector<Eigen::Vector3d> corners;  ///< in the order in which they were given
  std::size_t exactCorners = 0;          ///< how many the whole hull has
  double deviation = 0;                  ///< largest distance of a corner from the simple hull, m
};

/// At most `most` (4 or more) of the corners of a convex hull, so chosen that the others lie close
/// to the hull of those. A hull that has no more is given back as it is, with deviation 0. The same
/// corners give the same result, whatever the number of threads.
/// Errors: kBadInput for corners in one plane.
[[nodiscard]] Result<SimpleHull> simplifiedHull(const std::vector<Eigen::Vector3d>& corners,
                                                std::size_t most);

/// The hull that physics uses for a body of these points: the convex hull, simplified where it has
/// more than kMostHullVertices corners.
/// Errors: kBadInput as convexHull(), and for a simple hull that would be over 0.5 % of the size
/// off.
[[nodiscard]] Result<SimpleHull> hullForPhysics(const std::vector<Eigen::Vector3d>& points);

}  // namespace ifa
