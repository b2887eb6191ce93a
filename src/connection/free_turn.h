// SPDX-License-Identifier: Apache-2.0
// Where a torque-free rotation leads, and how that depends on the spin it starts with.
#pragma once

#include <Eigen/Core>

#include "dynamics/body_model.h"
#include "dynamics/free_rotation.h"

namespace ifa {

/// End of a torque-free rotation.
struct FreeTurn {
  Spin<double> end;  ///< orientation (unit), and angular velocity in the body frame, rad/s
  /// Small turn of the end, body frame at the end, per change of the first angular velocity, body
  /// frame at the start; s. Not set where it was not asked for.
  Eigen::Matrix3d slope;
};

/// Rotation of `start` for `duration` seconds (>= 0), as the kernel's flights go: closed form, or
/// series over turns of KernelSettings::segmentAngle. Thread safe.
[[nodiscard]] FreeTurn freeTurn(const BodyModel& model, const Spin<double>& start, double duration);

/// The same with its slope: in closed form, or from the variational equation
///   dw' = I^-1 (I dw x w + I w x dw),  e' = dw + e x w
/// (e: small turn, body frame), by series likewise; good to about 1e-6 of itself.
[[nodiscard]] FreeTurn freeTurnWithSlope(const BodyModel& model, const Spin<double>& start,
                                         double duration);

}  // namespace ifa
