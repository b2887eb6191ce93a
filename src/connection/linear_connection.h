// SPDX-License-Identifier: Apache-2.0
// Linear connection: the parabola between two places. IFA 5.3.2.
#pragma once

#include <Eigen/Core>

#include "model/rigid_state.h"

namespace ifa {

/// Velocity that carries the centre of mass from `from` to `to` in `duration` seconds under
/// gravity. IFA 5.3.2.
/// @param from, to  world frame, m
/// @param duration  s, > 0
/// @return velocity at the start of the flight, m/s
[[nodiscard]] inline Eigen::Vector3d linearConnection(const Eigen::Vector3d& from,
                                                      const Eigen::Vector3d& to, double duration) {
  return (to - from) / duration + Eigen::Vector3d(0, 0, 0.5 * kGravity * duration);
}

}  // namespace ifa
