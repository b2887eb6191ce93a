// SPDX-License-Identifier: Apache-2.0
// What every planner refuses.
#pragma once

#include "planner/planner.h"

namespace ifa {

/// Errors: kBadInput for a signature without events, or with events out of order.
[[nodiscard]] Result<void> checkRequest(const PlanRequest& request);

}  // namespace ifa
