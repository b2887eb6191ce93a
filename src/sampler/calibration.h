// SPDX-License-Identifier: Apache-2.0
// Finds the restitution (and where that is not enough, the friction) at which an object makes as
// many contact events per simulation as the paper's (Table 1, docs/objects.md).
#pragma once

#include <cstddef>
#include <cstdint>

#include "body/body.h"

namespace ifa {

struct CalibrationSettings {
  std::size_t simulations = 4000;  ///< per measurement; always the same initial states
  std::uint64_t seed = 1;
  double timeLimit = 20;    ///< s per drop
  double tolerance = 0.02;  ///< share of the target that ends the search
  double lowestRestitution = 0.3, highestRestitution = 0.9;
  double lowestFriction = 0.2, highestFriction = 0.6;
};

/// What drops on a surface give.
struct SurfaceMeasurement {
  double eventsPerSimulation = 0;  ///< by the paper's cut, any impulse above zero
  double audibleEvents = 0;        ///< per simulation, at the J_ref measured here
  double referenceImpulse = 0;     ///< J_ref: median of a drop's largest impulse in 1 ms, N s
  double restTime = 0;             ///< mean, s
  std::size_t unfinished = 0;      ///< drops that the time limit ended
};

struct Calibration {
  SurfaceProperties surface;  ///< with J_ref
  SurfaceMeasurement measured;
  bool reached = false;  ///< within the tolerance; else the nearest end of the range
};

/// Drops the body on `surface` with the native kernel, on all cores.
[[nodiscard]] SurfaceMeasurement measureSurface(const Body& body, const SurfaceProperties& surface,
                                                const CalibrationSettings& settings);

/// Bisects the restitution, then, where its range is too small, the friction.
/// @param start  friction, rolling and spinning friction to begin with
/// @param target  events per simulation by the paper's cut, > 0
[[nodiscard]] Calibration calibrateSurface(const Body& body, const SurfaceProperties& start,
                                           double target, const CalibrationSettings& settings);

}  // namespace ifa
