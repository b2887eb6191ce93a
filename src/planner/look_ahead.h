// SPDX-License-Identifier: Apache-2.0
// What is known of the edge after next before it is looked for. docs/branch-and-bound.md.
#pragma once

#include <cstdint>
#include <optional>

#include "dynamics/body_model.h"
#include "graph/contact_graph.h"
#include "planner/next_flight.h"
#include "planner/planner.h"

namespace ifa {

/// A transition, and what is known of the edge after it.
struct GraphChild {
  Transition transition;
  double bound = 0;  ///< log weight of that edge is no more
  double worth = 0;  ///< total weight, and the weight of that edge as far as it can be guessed
  double place = 0;  ///< log f_p where it leads, in `worth` too
};

/// Thread safe; request and graph must outlive it.
class LookAhead {
 public:
  LookAhead(const PlanRequest& request, const BodyModel& model);

  /// Sets `bound`, and adds to `worth`, for an event that meets the signature's event `level`, not
  /// the last one.
  void rate(int level, GraphChild& child) const;

 private:
  [[nodiscard]] std::optional<double> ownFlight(std::uint32_t event,
                                                const TransitionTarget& own) const;

  const PlanRequest& request_;
  const ContactGraph& graph_;
  NextFlight nextFlight_;
};

}  // namespace ifa
