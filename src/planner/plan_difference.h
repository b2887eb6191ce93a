// SPDX-License-Identifier: Apache-2.0
// When two plans are different takes, and not the same path turned, mirrored or relabelled.
#pragma once

#include <vector>

#include "planner/planner.h"

namespace ifa {

/// Whether, after the best planar registration, and of one of the two mirrored where that helps,
/// some contact (or the end) lies over 10 % of the path's length apart (docs/method.md 6). A body's
/// symmetry group does not change its path, so paths that differ are different takes whatever the
/// group.
[[nodiscard]] bool differentPaths(const Plan& a, const Plan& b);

}  // namespace ifa
