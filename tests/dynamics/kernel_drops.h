// SPDX-License-Identifier: Apache-2.0
// Whole drops by the kernel, looked at after every piece of motion.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "dynamics/energy.h"
#include "dynamics/stepper.h"

namespace ifa {

inline double lowestVertex(const BodyModel& model, const KernelState<double>& state) {
  const Vec<double> up = Rotation<double>(state.q).rows[2];
  double lowest = 1e9;
  for (std::size_t i = 0; i < model.x.size(); ++i) {
    lowest = std::min(lowest,
                      state.position.z + model.x[i] * up.x + model.y[i] * up.y + model.z[i] * up.z);
  }
  return lowest;
}

/// What the worst piece of a drop did.
struct DropCheck {
  double gain = -1e9;  ///< energy gained in one piece, share of the drop's first energy
  double depth = 0;    ///< of the lowest vertex under the ground, m
  bool rested = false;
  KernelState<double> end;
};

inline DropCheck checkDrop(const BodyModel& model, const RigidState& start, double timeLimit,
                           double restitution) {
  Stepper stepper(model);
  stepper.start(kernelState(start, 0), restitution);
  DropCheck check;
  const double first = totalEnergy(model, stepper.state());
  double energy = first;
  while (stepper.state().time < timeLimit && !check.rested) {
    const Advance did = stepper.advance(timeLimit);
    check.rested = did == Advance::kRest;
    const double now = totalEnergy(model, stepper.state());
    check.gain = std::max(check.gain, (now - energy) / first);
    energy = now;
    check.depth = std::max(check.depth, -lowestVertex(model, stepper.state()));
  }
  check.end = stepper.state();
  return check;
}

/// FNV-1a over the bits of a state.
inline std::uint64_t hashState(const KernelState<double>& s, std::uint64_t hash) {
  const double values[] = {s.time, s.position.x, s.position.y, s.position.z, s.q.w, s.q.x, s.q.y,
                           s.q.z,  s.velocity.x, s.velocity.y, s.velocity.z, s.w.x, s.w.y, s.w.z};
  for (const double value : values) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; ++i) {
      hash = (hash ^ ((bits >> (8 * i)) & 0xff)) * 1099511628211ULL;
    }
  }
  return hash;
}

}  // namespace ifa
