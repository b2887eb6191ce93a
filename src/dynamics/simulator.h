// SPDX-License-Identifier: Apache-2.0
// Simulation of one body that falls on a plane, from a state to rest (docs/dynamics.md).
#pragma once

#include <functional>
#include <vector>

#include "body/body.h"
#include "dynamics/body_model.h"
#include "model/contact_step.h"
#include "model/rigid_state.h"

namespace ifa {

/// Raised with every change after which the same start gives another motion, so that nothing stored
/// before is taken for the same.
inline constexpr unsigned kSimulationVersion = 3;

/// What a whole drop gave.
struct DropResult {
  bool atRest = false;             ///< false: the time limit came first
  double restTime = 0;             ///< s, when the body came to rest (or the limit)
  RigidState rest;                 ///< state then
  std::vector<ContactStep> steps;  ///< impacts and steps in contact, in order of time
};

/// Simulates from `start` (time 0, world frame, principal axes) until rest or `timeLimit` seconds.
/// Thread safe.
[[nodiscard]] DropResult simulateDrop(const Body& body, const SurfaceProperties& surface,
                                      const RigidState& start, double timeLimit);
/// The same for a model made beforehand; share it when many drops of one body are simulated.
[[nodiscard]] DropResult simulateDrop(const BodyModel& model, const RigidState& start,
                                      double timeLimit);

}  // namespace ifa
