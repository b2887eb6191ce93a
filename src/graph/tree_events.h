// SPDX-License-Identifier: Apache-2.0
// The flights of a database in the coordinates of the search trees.
#pragma once

#include <vector>

#include "affinity/factors.h"
#include "base/progress.h"
#include "body/symmetry.h"
#include "database/database.h"
#include "graph/event_tree.h"
#include "ifa/result.h"

namespace ifa {

/// Flights to events that are not terminal, and to those that are.
struct TreeEvents {
  std::vector<TreeEvent> onward, ending;
};

/// Which image of an event the trees keep, so that all events lie close together: that from which
/// the plane's normal is seen nearest to one direction. Thread safe.
class Folding {
 public:
  explicit Folding(const SymmetryGroup& group);

  /// Element of the group whose image of event `event` is kept.
  [[nodiscard]] std::size_t elementOf(const EventDatabase& database, std::size_t event) const;
  /// Likewise. @param up  the plane's normal as the body sees it
  [[nodiscard]] std::size_t elementOf(const Eigen::Vector3d& up) const;

 private:
  std::vector<Eigen::Vector3d> directions_;
};

/// Every event that flight follows, as its image under Folding, in order of the events, on the
/// worker threads. Errors: kInterrupted.
[[nodiscard]] Result<TreeEvents> treeEvents(const EventDatabase& database,
                                            const SymmetryGroup& group, const Progress& progress);

/// Typical sizes of this database's plausible regions and sounds.
[[nodiscard]] TreeScales treeScales(const EventDatabase& database, const AffinityParameters& p);

}  // namespace ifa
