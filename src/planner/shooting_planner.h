// SPDX-License-Identifier: Apache-2.0
// Guided shooting: physics between contacts exact, only contact impulses changed (docs/planner.md).
#pragma once

#include "planner/planner.h"
#include "planner/shooting_settings.h"

namespace ifa {

class ShootingPlanner : public Planner {
 public:
  explicit ShootingPlanner(const ShootingSettings& settings = {}) : settings_(settings) {}
  [[nodiscard]] Result<std::vector<Plan>> plan(const PlanRequest& request,
                                               const Progress& progress) const override;

 private:
  ShootingSettings settings_;
};

}  // namespace ifa
