// SPDX-License-Identifier: Apache-2.0
// Guided shooting: physics between contacts exact, only contact impulses changed (docs/planner.md).
#pragma once

#include "planner/planner.h"
#include "planner/shooting_planner_settings.h"

namespace ifa {

class ShootingPlanner : public Planner {
 public:
  explicit ShootingPlanner(const ShootingPlannerSettings& settings = {}) : settings_(settings) {}
  [[nodiscard]] Result<std::vector<Plan>> plan(const PlanRequest& request,
                                               const Progress& progress) const override;

 private:
  ShootingPlannerSettings settings_;
};

}  // namespace ifa
