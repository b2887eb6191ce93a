// SPDX-License-Identifier: Apache-2.0
// Energy of a state, J; potential energy counts from the ground plane.
#pragma once

#include "dynamics/body_model.h"
#include "dynamics/kernel_state.h"

namespace ifa {

/// @param velocity  world frame, m/s. @param w  body frame, rad/s
inline double kineticEnergy(const BodyModel& body, const Vec<double>& velocity,
                            const Vec<double>& w) {
  return 0.5 * (body.mass * dot(velocity, velocity) + body.inertia.x * w.x * w.x +
                body.inertia.y * w.y * w.y + body.inertia.z * w.z * w.z);
}

inline double totalEnergy(const BodyModel& body, const KernelState<double>& state) {
  return kineticEnergy(body, state.velocity, state.w) + body.mass * kGravity * state.position.z;
}

inline double totalEnergy(const BodyModel& body, const RigidState& state) {
  return totalEnergy(body, kernelState(state, 0));
}

}  // namespace ifa
