// SPDX-License-Identifier: Apache-2.0
// Which vertices carry a body, and whether it can stand on them.
#pragma once

#include <cstdint>
#include <vector>

#include "dynamics/body_model.h"

namespace ifa {

/// Where a vertex is, seen from above and from the centre of mass, m.
struct Spot {
  double x, y;
};

/// A vertex near the ground.
struct LowSpot {
  Spot spot;
  double gap;           ///< m
  std::int64_t number;  ///< whatever the caller knows it by
};

/// Keeps `most` of more `spots`: the lowest one, then always the one farthest from those kept, in
/// that order, so that a body on a round base does not rock for want of support.
void thinBySpread(std::size_t most, std::vector<LowSpot>& spots);

/// The centre of mass is above the polygon of the vertices at the ground.
[[nodiscard]] bool isSupported(const std::vector<Spot>& spots, const BodyModel& body);

}  // namespace ifa
