// SPDX-License-Identifier: Apache-2.0
// Which vertices carry a body, and whether it can stand on them.
#pragma once

#include <vector>

#include "dynamics/ground_watch.h"

namespace ifa {

/// Keeps at most `most` of the `chosen` (numbers in the list of `watch`): the lowest one, then
/// always the one farthest from those kept, so that a body on a round base does not rock for want
/// of support.
void thinBySpread(const GroundWatch& watch, const GroundFrame& frame,
                  const Rotation<double>& rotation, std::size_t most,
                  std::vector<std::size_t>& chosen);

/// The centre of mass is above the polygon of the vertices at the ground.
[[nodiscard]] bool isSupported(const GroundWatch& watch, const GroundFrame& frame,
                               const Rotation<double>& rotation, const BodyModel& body);

}  // namespace ifa
