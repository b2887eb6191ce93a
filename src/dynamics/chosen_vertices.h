// SPDX-License-Identifier: Apache-2.0
// For each lane a list of vertices of its own.
#ifndef IFA_DYNAMICS_CHOSEN_VERTICES_H
#define IFA_DYNAMICS_CHOSEN_VERTICES_H

#include <algorithm>
#include <bit>
#include <cstdint>

#include "dynamics/lane.h"

namespace ifa {

/// At most kMost numbers of vertices, in the order in which they were added; more are left out.
template <class R, std::size_t kMost>
class ChosenVertices {
 public:
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;
  using Index = typename LaneTraits<R>::Index;

  ChosenVertices() { clear(); }

  void clear() {
    std::fill(counts_, counts_ + kLanes, 0);
    most_ = 0;
  }
  void add(const LaneMask<R>& lanes, std::size_t vertex) {
    for (unsigned bits = laneBits(lanes); bits != 0; bits &= bits - 1) {
      addTo(static_cast<std::size_t>(std::countr_zero(bits)), static_cast<std::int64_t>(vertex));
    }
  }
  /// Adds those of each lane's set, a whole number with a bit for each vertex from number `first`
  /// on.
  void addSets(const R& sets, std::size_t first) {
    if (most_ == 0) {
      takeSets(indexOf(sets), R(static_cast<double>(first)));
      return;
    }
    alignas(kLanes * sizeof(double)) double numbers[kLanes];
    storeLanes(sets, numbers);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (auto bits = static_cast<std::uint64_t>(numbers[lane]); bits != 0; bits &= bits - 1) {
        addTo(lane, static_cast<std::int64_t>(first) + std::countr_zero(bits));
      }
    }
  }
  /// Of the lane that has most.
  [[nodiscard]] int count() const { return most_; }
  [[nodiscard]] int count(std::size_t lane) const { return static_cast<int>(counts_[lane]); }
  void shorten(std::size_t lane, int count) {
    counts_[lane] = count;
    most_ = static_cast<int>(*std::max_element(counts_, counts_ + kLanes));
  }
  [[nodiscard]] std::int64_t& number(std::size_t k, std::size_t lane) {
    return numbers_[k * kLanes + lane];
  }
  /// Lanes that have more than `k`.
  [[nodiscard]] LaneMask<R> lanesWith(int k) const { return R(k) < loadLanes<R>(counts_); }
  /// Number `k` of each lane; 0 where it has fewer, so that it may be looked up.
  [[nodiscard]] Index at(int k) const {
    return orZero(lanesWith(k), loadIndices<R>(numbers_ + static_cast<std::size_t>(k) * kLanes));
  }

 private:
  /// The first sets, all lanes at once.
  void takeSets(Index sets, const R& first) {
    R counts(0.0);
    for (std::size_t k = 0; k < kMost; ++k) {
      const LaneMask<R> some = hasBits(sets);
      if (!anyLane(some)) break;
      storeIndices(indexOf(first + takeLowestBit(sets)), numbers_ + k * kLanes);
      setWhere(some, counts, counts + R(1.0));
      ++most_;
    }
    storeLanes(counts, counts_);
  }
  void addTo(std::size_t lane, std::int64_t vertex) {
    const auto place = static_cast<std::size_t>(counts_[lane]);
    if (place >= kMost) return;
    numbers_[place * kLanes + lane] = vertex;
    counts_[lane] += 1;
    most_ = std::max(most_, static_cast<int>(counts_[lane]));
  }

  int most_ = 0;  ///< of counts_
  alignas(kLanes * sizeof(double)) double counts_[kLanes];
  alignas(kLanes * sizeof(double)) std::int64_t numbers_[kMost * kLanes];
};

/// Gathers vertices for ChosenVertices, in rising order, without a branch for each.
template <class R, std::size_t kMost>
class VertexSets {
 public:
  explicit VertexSets(ChosenVertices<R, kMost>& chosen) : chosen_(chosen) { chosen.clear(); }

  void add(const LaneMask<R>& lanes, int vertex) {
    if constexpr (LaneTraits<R>::kLanes == 1) {
      chosen_.add(lanes, static_cast<std::size_t>(vertex));
    } else {
      if (vertex - first_ >= kBits) finish(vertex);
      setWhere(lanes, sets_, sets_ + R(static_cast<double>(std::int64_t{1} << (vertex - first_))));
    }
  }
  /// To be called after the last.
  void finish(int next = 0) {
    if constexpr (LaneTraits<R>::kLanes > 1) {
      chosen_.addSets(sets_, static_cast<std::size_t>(first_));
      sets_ = R(0.0);
      first_ = next;
    }
  }

 private:
  static constexpr int kBits = 52;  ///< of a double

  ChosenVertices<R, kMost>& chosen_;
  R sets_{};
  int first_ = 0;
};

}  // namespace ifa

#endif
