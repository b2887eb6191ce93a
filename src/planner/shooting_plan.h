// SPDX-License-Identifier: Apache-2.0
// What a pass of guided shooting comes to: a plan, or the reason why there is none.
#pragma once

#include <string>
#include <vector>

#include "planner/planner.h"
#include "planner/shooting_search.h"

namespace ifa {

/// The plan of a path of nodes, the first contact first.
[[nodiscard]] Plan planOf(const ShootingProblem& problem, const std::vector<ShootingNode>& path);

/// Which contact was not met, and why, for people.
/// @param farthest  the best motion of those that got farthest; null when there is none
/// @param leastScore  of a complete motion that counts as a solution
[[nodiscard]] std::string failureOf(const ShootingProblem& problem, const ShootingSearch& search,
                                    const ShootingNode* farthest, double leastScore);

}  // namespace ifa
