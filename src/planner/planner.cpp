// SPDX-License-Identifier: Apache-2.0
#include "planner/planner.h"

#include <algorithm>

#include "planner/graph_planner.h"
#include "planner/shooting_planner.h"

namespace ifa {

void sumUp(Plan& plan, const LogScore& log) {
  const int n = static_cast<int>(plan.contacts.size());
  plan.score = log.score(n);
  plan.scoreWithoutSound = log.scoreWithoutSound(n);
  plan.meanFv = log.meanVelocity(n);
  std::vector<double> bends;
  for (const PlannedContact& contact : plan.contacts) bends.push_back(contact.bend);
  std::sort(bends.begin(), bends.end());
  plan.bendMax = bends.back();
  plan.bendMedian = 0.5 * (bends[(bends.size() - 1) / 2] + bends[bends.size() / 2]);
}

Result<std::unique_ptr<Planner>> makePlanner(const std::string& name) {
  if (name == "hybrid") {
    return std::make_unique<ShootingPlanner>(ShootingPlannerSettings::hybrid());
  }
  if (name == "shoot") return std::make_unique<ShootingPlanner>();
  if (name == "graph") return std::make_unique<GraphPlanner>();
  return tl::unexpected<Error>({ErrorCode::kUsage, "there is no planner \"" + name + "\"",
                                "--planner", "use hybrid, shoot or graph"});
}

}  // namespace ifa
