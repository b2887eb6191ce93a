// SPDX-License-Identifier: Apache-2.0
#include "planner/planner.h"

#include "planner/graph_planner.h"
#include "planner/shooting_planner.h"

namespace ifa {

Result<std::unique_ptr<Planner>> makePlanner(const std::string& name) {
  if (name == "shoot") return std::make_unique<ShootingPlanner>();
  if (name == "graph") return std::make_unique<GraphPlanner>();
  return tl::unexpected<Error>({ErrorCode::kUsage, "there is no planner \"" + name + "\"",
                                "--planner", "use shoot or graph"});
}

}  // namespace ifa
