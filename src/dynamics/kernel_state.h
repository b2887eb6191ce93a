// SPDX-License-Identifier: Apache-2.0
// State of the kernel, and its way from and to RigidState.
#pragma once

#include "dynamics/lane_state.h"
#include "model/rigid_state.h"

namespace ifa {

inline KernelState<double> kernelState(const RigidState& state, double time) {
  KernelState<double> k;
  k.time = time;
  k.position = {state.position.x(), state.position.y(), state.position.z()};
  k.q = {state.orientation.w(), state.orientation.x(), state.orientation.y(),
         state.orientation.z()};
  k.velocity = {state.velocity.x(), state.velocity.y(), state.velocity.z()};
  const Vec<double> w = {state.angularVelocity.x(), state.angularVelocity.y(),
                         state.angularVelocity.z()};
  k.w = Rotation<double>(k.q).transposed(w);
  return k;
}

inline RigidState rigidState(const KernelState<double>& k) {
  const Vec<double> w = Rotation<double>(k.q) * k.w;
  RigidState state;
  state.position = {k.position.x, k.position.y, k.position.z};
  state.orientation = Eigen::Quaterniond(k.q.w, k.q.x, k.q.y, k.q.z);
  state.velocity = {k.velocity.x, k.velocity.y, k.velocity.z};
  state.angularVelocity = {w.x, w.y, w.z};
  return state;
}

}  // namespace ifa
