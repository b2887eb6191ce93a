// SPDX-License-Identifier: Apache-2.0
// The same drop as simulateDrop, simulated by the Open Dynamics Engine: the oracle that our own
// kernel is compared with, and the backend that the paper used.
#pragma once

#include "body/body.h"
#include "dynamics/simulator.h"
#include "model/rigid_state.h"

namespace ifa {

/// How ODE is run. The defaults are the fastest that kept its physics in our measurements.
struct OdeSettings {
  double step = 1e-3;  ///< s; also the bin in which impulses are told
  /// m/s; slower touches do not bounce. ODE's restitution is erratic below 0.05 m/s.
  double bounceThreshold = 0.02;
  /// Share of the penetration that is pushed out in a step.
  double errorReduction = 0.2;
  /// m/s; cap on that push. Deep vertices of a fast impact would else be shot out of the ground.
  double maxCorrectingVelocity = 0.1;
  /// Contacts of a step, at most kMaxOdeContacts; chosen by depth, then by spread.
  int maxContacts = 8;
  double restSpeed = 0.02;   ///< m/s; kinetic speed sqrt(2 E / m) under which a body is quiet
  double restWindow = 0.05;  ///< s; so long quiet is rest
  bool recordSteps = true;   ///< false leaves DropResult::steps empty, for speed
};

inline constexpr int kMaxOdeContacts = 16;

/// Simulates one drop with dWorldStep (Dantzig's solver, friction pyramid along the world's axes),
/// the hull's vertices tested against the plane by ourselves. Each touching step becomes one
/// ContactStep. `restTime` is the start of the quiet window, `rest` the state at its end. Uses
/// none of ODE's global state, so it is deterministic and thread safe.
/// @param start  time 0, world frame, principal axes
/// @param timeLimit  s
[[nodiscard]] DropResult simulateDropOde(const Body& body, const SurfaceProperties& surface,
                                         const RigidState& start, double timeLimit,
                                         const OdeSettings& settings = {});

}  // namespace ifa
