// SPDX-License-Identifier: Apache-2.0
// Energy of a state over lanes, J; potential energy counts from the ground plane.
#ifndef IFA_DYNAMICS_LANE_ENERGY_H
#define IFA_DYNAMICS_LANE_ENERGY_H

#include "dynamics/body_model.h"
#include "dynamics/lane_state.h"

namespace ifa {

/// @param velocity  world frame, m/s. @param w  body frame, rad/s
template <class R>
R kineticEnergy(const BodyModel& body, const Vec<R>& velocity, const Vec<R>& w) {
  return R(0.5) * (R(body.mass) * dot(velocity, velocity) + R(body.inertia.x) * w.x * w.x +
                   R(body.inertia.y) * w.y * w.y + R(body.inertia.z) * w.z * w.z);
}

template <class R>
R totalEnergy(const BodyModel& body, const KernelState<R>& state) {
  return kineticEnergy(body, state.velocity, state.w) + R(body.mass * kGravity) * state.position.z;
}

}  // namespace ifa

#endif
