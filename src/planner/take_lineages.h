// SPDX-License-Identifier: Apache-2.0
// Where a search that came to an ending has motions that would end as other takes, had they come so
// far (docs/planner.md).
#pragma once

#include <cstddef>
#include <vector>

#include "planner/planner.h"
#include "planner/shooting_search.h"

namespace ifa {

/// Motions of one level of a search that are none of the takes found, `root` telling which of them
/// go one way.
struct TakeLineages {
  std::size_t level = 0;
  std::size_t ways = 0;  ///< 0: there are none
  std::vector<ShootingNode> beam;
};

/// Those of the last level before `before` that has `wanted` ways, or of the one that has most.
[[nodiscard]] TakeLineages lineagesBeside(const std::vector<Plan>& found,
                                          const ShootingSearch& search, std::size_t wanted,
                                          std::size_t before);

}  // namespace ifa
