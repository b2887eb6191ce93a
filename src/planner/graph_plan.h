// SPDX-License-Identifier: Apache-2.0
// Turns a walk through the contact-event graph into a plan.
#pragma once

#include "planner/graph_search.h"

namespace ifa {

/// The plan of `path`, whose connections `connector` has made; its Score is that of the flights as
/// they were made (docs/method.md 4), but for f_v where it is wanted as printed.
[[nodiscard]] Plan planOf(const PlanRequest& request, const GraphPath& path,
                          PathConnector& connector);

}  // namespace ifa
