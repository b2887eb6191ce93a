// SPDX-License-Identifier: Apache-2.0
// Settings of the graph planner. IFA 5.5; docs/branch-and-bound.md.
#pragma once

#include <cstddef>

namespace ifa {

struct GraphPlannerSettings {
  int horizon = 5;           ///< contacts that a sub-path looks ahead; as printed
  int commit = 2;            ///< contacts of the best sub-path that are kept; as printed
  std::size_t children = 5;  ///< best transitions that a node is followed to; as printed
  /// Decision: as many times more transitions are looked for, of which those are followed whose
  /// weight with the vertical part of the next edge's f_v is best: a body that cannot rise to the
  /// next gap is left out. 1: as printed.
  std::size_t lookAhead = 8;
  std::size_t starts = 1000;       ///< first edges that are looked at; four times as many ...
  std::size_t mostStarts = 20000;  ///< ... where they lead nowhere, and so on up to this
  long mostQueries = 200000;       ///< nodes expanded before the search gives up, times effort
  int mostDeadEnds = 60;           ///< steps back on the way from one start

  /// Looks at everything there is: for tests, and for tiny databases.
  [[nodiscard]] static GraphPlannerSettings exhaustive() {
    GraphPlannerSettings all;
    all.horizon = all.commit = 1 << 20;
    all.lookAhead = 1;
    all.children = all.starts = all.mostStarts = static_cast<std::size_t>(-1) / 2;
    all.mostQueries = 1L << 40;
    return all;
  }
};

}  // namespace ifa
