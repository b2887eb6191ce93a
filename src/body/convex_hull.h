// SPDX-License-Identifier: Apache-2.0
// Convex hull of a set of points, by qhull.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ifa/result.h"

namespace ifa {

/// Corners of the convex hull, in the order of `points`. A corner that stands out by less than
/// `relativeTolerance` times the set's extent is left out, so that flat facets keep only their true
/// corners.
/// Errors: kBadInput for fewer than 4 points, points in one plane, or numbers that are not finite.
[[nodiscard]] Result<std::vector<Eigen::Vector3d>> convexHull(
    const std::vector<Eigen::Vector3d>& points, double relativeTolerance = 1e-6);

}  // namespace ifa
