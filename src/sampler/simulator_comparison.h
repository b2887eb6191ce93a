// SPDX-License-Identifier: Apache-2.0
// Our kernel against ODE: the same drops, and how far apart their statistics are.
#pragma once

#include <cstddef>
#include <cstdint>

#include "body/body.h"
#include "dynamics/ode_backend.h"
#include "sampler/drop_statistics.h"

namespace ifa {

/// Decision: ODE steps 0.25 ms here. At 1 ms a fast vertex sinks up to 4 mm before ODE sees it, its
/// neighbours then hit with it, and what is compared is that step and not the laws of contact.
inline OdeSettings fineOde() {
  OdeSettings settings;
  settings.step = 2.5e-4;
  return settings;
}

struct ComparisonSettings {
  std::size_t drops = 2000;
  std::uint64_t seed = 1;
  double timeLimit = 20;  ///< s
  OdeSettings ode = fineOde();
};

/// Statistics of both, and Kolmogorov-Smirnov distances between them.
struct SimulatorComparison {
  DropStatistics native, ode;
  double eventCounts = 0;  ///< D of the numbers of audible events
  double restTimes = 0;    ///< D of timeToRest
  double gaps = 0;         ///< D of the times between audible events' starts
};

/// Drops the body on `surface` in both simulators, on all cores. Where the surface has no J_ref,
/// the native drops' own is taken for both.
[[nodiscard]] SimulatorComparison compareWithOde(const Body& body, SurfaceProperties surface,
                                                 const ComparisonSettings& settings);

}  // namespace ifa
