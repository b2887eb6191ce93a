// SPDX-License-Identifier: Apache-2.0
// Lays motions on one floor so that no body ever comes near another (docs/music.md).
#pragma once

#include <cstdint>
#include <vector>

#include "body/body.h"
#include "ifa/motion.h"
#include "ifa/progress.h"
#include "ifa/result.h"
#include "model/floor_place.h"

namespace ifa {

/// A motion in the time of the ensemble, which is that of its sound: `motion->sound.firstContact`
/// is where its first contact lies.
struct EnsembleMember {
  const Motion* motion = nullptr;  ///< with samples
  const Body* body = nullptr;
};

struct PlacingSettings {
  double clearance = 0.005;  ///< m between any two bodies at any time, at least
  std::uint64_t seed = 1;
};

/// One place for each member, the first ones nearest to the middle. A body takes part from where
/// its motion begins to the end of all. Between the instants that are looked at, bodies cannot come
/// nearer than `clearance`: steps are as short as distance and speeds ask for (conservative
/// advancement). The same input gives the same places.
/// Errors: kInterrupted; kNoMotion where no free place is found.
[[nodiscard]] Result<std::vector<FloorPlace>> placeBodies(
    const std::vector<EnsembleMember>& members, const PlacingSettings& settings,
    const Progress& progress = {});

}  // namespace ifa
