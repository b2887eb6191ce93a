// SPDX-License-Identifier: Apache-2.0
// The takes of guided shooting, gathered over its passes, and what work there is for more than one
// (docs/planner.md).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "planner/planner.h"
#include "planner/shooting_search.h"

namespace ifa {

/// A plan below this Score is not called solved (docs/method.md 4).
inline constexpr double kLeastScore = 0.5;

/// Different takes, best first. The problem must outlive it.
class Takes {
 public:
  explicit Takes(const ShootingProblem& problem) : problem_(problem) {}

  /// Of the takes so far and the complete motions of a search, keeps the best.
  void add(const ShootingSearch& search);
  /// Makes up for what is missing, and for what is much worse than the best, with good takes whose
  /// body lands elsewhere (MovedLandings).
  void move();

  [[nodiscard]] bool enough() const { return plans_.size() >= wanted(); }
  /// How many are missing, or much worse than the best.
  [[nodiscard]] std::size_t missing() const;
  [[nodiscard]] std::vector<Plan>& plans() { return plans_; }
  /// Whether a motion did not hold its audit.
  [[nodiscard]] bool refused() const { return refused_ > 0; }

 private:
  [[nodiscard]] std::size_t wanted() const {
    return static_cast<std::size_t>(problem_.request.settings.takes);
  }
  [[nodiscard]] double goodScore() const;
  void moveAll(double leastScore);
  void moveFrom(std::size_t first, double leastScore);
  void addIfNew(Plan& plan);
  [[nodiscard]] bool isAccepted(Plan& plan);

  const ShootingProblem& problem_;
  std::vector<Plan> plans_;
  int refused_ = 0;
};

/// How much work is left for more takes than one, counted as ShootingWork::cost.
class TakesBudget {
 public:
  /// @param times  all takes together may cost so many times what one does
  explicit TakesBudget(double times) : times_(times) {}
  /// Whether it is known what one costs.
  [[nodiscard]] bool priced() const { return price_ > 0; }
  [[nodiscard]] double left() const { return times_ * price_ - work_; }
  /// How wide the next pass may be, one of `planned` costing as much for its width as those so far.
  [[nodiscard]] double width(double planned) const {
    return priced() ? std::min(planned, left() * widths_ / work_) : planned;
  }
  void count(double cost) { work_ += cost; }
  /// A pass was made. @param one  whether a single take would be settled by now
  void passed(double width, bool one) {
    widths_ += width;
    if (one && !priced()) price_ = work_;
  }

 private:
  double times_, work_ = 0, widths_ = 0, price_ = 0;
};

}  // namespace ifa
