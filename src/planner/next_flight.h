// SPDX-License-Identifier: Apache-2.0
// What the flight that leaves an event will cost, before any is looked for.
// docs/branch-and-bound.md.
#pragma once

#include <cstdint>
#include <utility>

#include "graph/contact_graph.h"

namespace ifa {

/// The height of a body in contact lies between narrow limits, and so does the vertical velocity
/// that a flight between two contacts takes: how far the event's own is from it is known
/// beforehand. Thread safe; the graph must outlive it.
class NextFlight {
 public:
  /// @param radius  of the body, m
  NextFlight(const ContactGraph& graph, double radius);

  struct Cost {
    double bound = 0;  ///< log f_v of any edge is no more; -infinity: none leaves
    double guess = 0;  ///< log f_v where the next contact is as high, and nothing else changes
  };
  /// @param event  that is left  @param time  T*, s
  [[nodiscard]] Cost cost(std::uint32_t event, double time) const;

 private:
  [[nodiscard]] std::pair<double, double> climbs(double time, double height) const;

  const ContactGraph& graph_;
  double radius_;
  double lowest_ = 0;  ///< height of the centre of mass in any contact, m
};

}  // namespace ifa
