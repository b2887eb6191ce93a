// SPDX-License-Identifier: Apache-2.0
// The flights of a database in the coordinates of the search trees.
#pragma once

#include <vector>

#include "affinity/factors.h"
#include "base/progress.h"
#include "database/database.h"
#include "graph/event_tree.h"
#include "ifa/result.h"

namespace ifa {

/// Flights to events that are not terminal, and to those that are.
struct TreeEvents {
  std::vector<TreeEvent> onward, ending;
};

/// Every event that flight follows, in order of the events, on the worker threads. Errors:
/// kInterrupted.
[[nodiscard]] Result<TreeEvents> treeEvents(const EventDatabase& database,
                                            const Progress& progress);

/// Typical sizes of this database's plausible regions and sounds.
[[nodiscard]] TreeScales treeScales(const EventDatabase& database, const AffinityParameters& p);

}  // namespace ifa
