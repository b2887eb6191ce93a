// SPDX-License-Identifier: Apache-2.0
// How far a motion is from the orientations that were asked of it (IFA section 6).
#pragma once

#include <numbers>
#include <vector>

#include "ifa/motion.h"

namespace ifa {

/// What counts as met, rad: c_o sets the half-width of f_o to 4 degrees.
inline constexpr double kOrientationMet = 4 * std::numbers::pi / 180;

/// The angle of each of `motion.orientations` between where the body's direction points and where
/// it was asked to, rad. The motion has samples.
[[nodiscard]] std::vector<double> orientationErrors(const Motion& motion);

}  // namespace ifa
