// SPDX-License-Identifier: Apache-2.0
// The best few of many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace ifa {

/// Keeps the `count` items with the largest `total`, best first; of equal ones those that came
/// first.
template <class T>
class BestList {
 public:
  explicit BestList(std::size_t count) : count_(count) {}

  /// An item with less is not taken.
  [[nodiscard]] double least() const {
    return items_.size() < count_ ? -std::numeric_limits<double>::infinity()
           : count_ == 0          ? std::numeric_limits<double>::infinity()
                                  : items_.back().total;
  }
  void add(T item) {
    if (items_.size() >= count_ && !(item.total > least())) return;
    const auto better = [](const T& a, const T& b) { return a.total > b.total; };
    items_.insert(std::upper_bound(items_.begin(), items_.end(), item, better), std::move(item));
    if (items_.size() > count_) items_.pop_back();
  }
  [[nodiscard]] std::vector<T> take() { return std::move(items_); }

 private:
  std::size_t count_;
  std::vector<T> items_;
};

}  // namespace ifa
