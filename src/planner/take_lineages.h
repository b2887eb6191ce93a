// SPDX-License-Identifier: Apache-2.0
// Where a search that came to an ending has motions that would end as other takes, had they come so
// far (docs/planner.md).
#pragma once

#include <cstddef>
#include <vector>

#include "planner/planner.h"
#include "planner/shooting_search.h"

namespace ifa {

/// Motions of one level of a search that are none of the takes found, to go on from, each way in
/// its turn.
struct TakeLineages {
  std::size_t ways = 0;  ///< that they go; 0: there are none
  ShootingSearch::Beginning beginning;
};

/// Those of the last level before `before` that has `wanted` ways, or of the one that has most.
[[nodiscard]] TakeLineages lineagesBeside(const std::vector<Plan>& found,
                                          const ShootingSearch& search, std::size_t wanted,
                                          std::size_t before);

}  // namespace ifa
