// SPDX-License-Identifier: Apache-2.0
// When two plans are different takes, and not the same motion turned, mirrored or relabelled.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "planner/planner.h"

namespace ifa {

/// Contacts that lie farther apart make a difference, as a share of the path's length.
inline constexpr double kDifferentShare = 0.1;

/// Where the contacts begin, and where the last one ends: world, from above, m.
[[nodiscard]] std::vector<Eigen::Vector2d> pathOf(const Plan& plan);

/// Whether two plans are different takes (docs/planner.md): after the best planar registration,
/// and whatever element of the group is applied, their final poses differ by over 20 degrees, or
/// some contact (or the end) lies over 10 % of the path's length apart. Decision: registered by
/// their paths and by their final poses; one that makes them the same is enough. A mirror image is
/// the same take where the group holds an improper element, which makes it a motion of the same
/// body.
/// @param group  orthogonal maps of the body onto itself, principal frame; empty: the identity
[[nodiscard]] bool differentTakes(const Plan& a, const Plan& b,
                                  std::span<const Eigen::Matrix3d> group = {});

/// The part of it that looks at paths alone, mirrored or not.
[[nodiscard]] bool differentPaths(const Plan& a, const Plan& b);
[[nodiscard]] bool differentPaths(std::vector<Eigen::Vector2d> a, std::vector<Eigen::Vector2d> b);

}  // namespace ifa
