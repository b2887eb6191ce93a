// SPDX-License-Identifier: Apache-2.0
// Search tree over the flights of a database: a k-d tree whose scales come with the query.
// docs/neighbours.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/tree_query.h"

namespace ifa {

/// A flight j to k as the tree keeps it, seen from the body at j+: what no motion of the plane
/// changes.
struct TreeEvent {
  std::array<float, kTreeColumns> values;  ///< by TreeColumn
  std::uint32_t sibling;                   ///< event j
};

/// How the axes of the space compare, for choosing where to split; no result depends on them.
struct TreeScales {
  float velocity = 1;    ///< typical half-axis of eq. 2's linear part per speed
  float spin = 1;        ///< of the angular part per spin
  float amplitude = 1;   ///< N s
  float sound = 0.012F;  ///< durations and centroids, s
};

/// A find, by weight in single precision.
struct TreeFind {
  float total = 0;
  std::uint32_t sibling = 0;
  std::uint32_t query = 0;  ///< of those that were asked together

  /// Better first.
  bool operator<(const TreeFind& other) const {
    if (total != other.total) return total > other.total;
    return sibling != other.sibling ? sibling < other.sibling : query < other.query;
  }
};

/// Read only once built; thread safe.
class EventTree {
 public:
  EventTree() = default;
  /// Takes the events and sorts them in place, on the worker threads; the same tree whatever their
  /// number.
  EventTree(std::vector<TreeEvent> events, const TreeScales& scales);

  /// The best `count` finds, and some that may be as good, best first. Looks into at most
  /// `mostLeaves` leaves (0: all that may hold one), the most promising first.
  [[nodiscard]] std::vector<TreeFind> find(const TreeQuery& query, std::size_t count,
                                           std::size_t mostLeaves) const {
    return find(std::span(&query, 1), count, mostLeaves);
  }
  /// The best of several queries together, each sibling once, with the query that suits it best.
  /// @param mostLeaves  of all queries together; a leaf counts once for each that looks into it
  [[nodiscard]] std::vector<TreeFind> find(std::span<const TreeQuery> queries, std::size_t count,
                                           std::size_t mostLeaves) const;
  /// The same by looking into every leaf, one after another: as fast as all can be read.
  [[nodiscard]] std::vector<TreeFind> scan(const TreeQuery& query, std::size_t count) const;
  [[nodiscard]] std::size_t leaves() const { return leaves_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class TreeBuilder;
  [[nodiscard]] const float* leaf(std::size_t number) const;

  std::size_t leaves_ = 0;
  /// Leaf after leaf, each column after column: kLeafEvents values each, then the siblings.
  std::vector<TreeEvent> events_;
  std::vector<TreeNode> nodes_;  ///< the first is the root
};

}  // namespace ifa
