// SPDX-License-Identifier: Apache-2.0
// Root finding where a motion is only known by simulating it: the next audible contact shall come
// on time, and comes too early, too late, or after a jump from one to the other (docs/planner.md).
#pragma once

#include <functional>
#include <optional>

#include "base/random.h"
#include "planner/event_simulation.h"
#include "planner/flight_timing.h"

namespace ifa {

/// A silent passage is timed to this, s; contact starts are exact to it.
inline constexpr double kSilentPrecision = 1e-6;
/// Stands for a time that never comes, s.
inline constexpr double kNever = 1e8;

/// A change of velocity, and by how much the next audible contact then comes too late, s.
struct SilentProbe {
  Coordinates y = Coordinates::Zero();
  double off = 0;  ///< kNever: the change is not allowed
  Eigen::Vector3d up =
      Eigen::Vector3d::Zero();  ///< the vertical seen from the body there; 0: not heard
};

/// What a simulation says about a change; contacts after the horizon are all just too late.
[[nodiscard]] SilentProbe silentProbe(const Coordinates& y, const std::optional<NextContact>& next,
                                      double horizon, double duration);

struct SilentSearchSettings {
  int probes = 16;       ///< changes tried
  int tries = 3;         ///< pairs of them, one too early and one too late, that are followed up
  double spread = 0.45;  ///< standard deviation of a change, in units of the plausible region
  double precision = kSilentPrecision;  ///< what is off by less is on time, s
};

/// Tries some changes, and between two of which one comes too early and one too late looks for one
/// that comes on time. `probe` simulates one; `found` is called right after a `probe` that is on
/// time.
void findOnTime(const std::function<SilentProbe(const Coordinates&)>& probe,
                const std::function<void()>& found, const SilentSearchSettings& settings,
                RandomStream& random);

/// Nearly normal with standard deviation 1, without transcendental functions: four uniform numbers
/// added up.
[[nodiscard]] double bellShaped(RandomStream& random);

}  // namespace ifa
