// SPDX-License-Identifier: Apache-2.0
// Energy of a state, J; potential energy counts from the ground plane.
#pragma once

#include "dynamics/kernel_state.h"
#include "dynamics/lane_energy.h"

namespace ifa {

inline double totalEnergy(const BodyModel& body, const RigidState& state) {
  return totalEnergy(body, kernelState(state, 0));
}

}  // namespace ifa
