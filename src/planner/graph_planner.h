// SPDX-License-Identifier: Apache-2.0
// The planner of IFA section 5: branch and bound over the contact-event graph of a database.
// docs/branch-and-bound.md.
#pragma once

#include <string>
#include <vector>

#include "planner/graph_planner_settings.h"
#include "planner/planner.h"

namespace ifa {

/// Needs `PlanRequest::graph`; else kUsage. Solved means here that a path was found, whatever its
/// Score.
class GraphPlanner : public Planner {
 public:
  explicit GraphPlanner(GraphPlannerSettings settings = {}) : settings_(settings) {}
  [[nodiscard]] Result<std::vector<Plan>> plan(const PlanRequest& request,
                                               const Progress& progress) const override;

 private:
  GraphPlannerSettings settings_;
};

}  // namespace ifa
