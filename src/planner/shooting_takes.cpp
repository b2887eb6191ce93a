// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_takes.h"

#include <optional>
#include <utility>

#include "planner/moved_landings.h"
#include "planner/plan_difference.h"
#include "planner/shooting_plan.h"

namespace ifa {

namespace {

/// Takes of a Score that is less than this share of the best one's are better made of good ones.
constexpr double kGoodShare = 0.9;
constexpr int kMostRefused = 20;

void sort(std::vector<Plan>& plans) {
  std::stable_sort(plans.begin(), plans.end(),
                   [](const Plan& a, const Plan& b) { return a.worth > b.worth; });
}

}  // namespace

void Takes::add(const ShootingSearch& search) {
  std::vector<Plan> found = std::exchange(plans_, {});
  for (const ShootingNode& node : search.complete()) {
    if (node.log.score(static_cast<int>(search.levels())) < kLeastScore) break;
    Plan plan = planOf(problem_, search.path(node));
    if (OrientationWishes::met(plan)) found.push_back(std::move(plan));
  }
  sort(found);
  for (Plan& plan : found) addIfNew(plan);
}

void Takes::addIfNew(Plan& plan) {
  const bool isNew = std::all_of(plans_.begin(), plans_.end(), [&](const Plan& other) {
    return differentTakes(plan, other, problem_.request.symmetry);
  });
  if (!enough() && isNew && isAccepted(plan)) plans_.push_back(std::move(plan));
}

/// Those that were taken before have been.
bool Takes::isAccepted(Plan& plan) {
  if (plan.solved) return true;
  if (refused_ == kMostRefused) return false;
  plan.solved = true;
  plan.bendCap = problem_.request.settings.bendCap;
  if (problem_.request.accepted(plan)) return true;
  ++refused_;
  return false;
}

double Takes::goodScore() const {
  return std::max(kLeastScore, plans_.empty() ? 0 : kGoodShare * plans_[0].score);
}

std::size_t Takes::missing() const {
  const double good = goodScore();
  const auto found = std::count_if(plans_.begin(), plans_.end(),
                                   [&](const Plan& plan) { return plan.score >= good; });
  return wanted() - static_cast<std::size_t>(found);
}

void Takes::move() {
  const double good = goodScore();
  const auto poor = std::stable_partition(plans_.begin(), plans_.end(),
                                          [&](const Plan& plan) { return plan.score >= good; });
  std::vector<Plan> rest(poor, plans_.end());
  plans_.erase(poor, plans_.end());
  moveAll(good);
  for (Plan& plan : rest) addIfNew(plan);
  moveAll(kLeastScore);
  sort(plans_);
}

void Takes::moveAll(double leastScore) {
  // What was moved can be moved again.
  for (std::size_t first = 0; first < plans_.size() && !enough();) {
    const std::size_t next = plans_.size();
    moveFrom(first, leastScore);
    first = next;
  }
}

/// Adds what can be made of the takes from number `first` on.
void Takes::moveFrom(std::size_t first, double leastScore) {
  std::vector<MovedLandings> guides;
  for (std::size_t i = first; i < plans_.size(); ++i) guides.emplace_back(problem_, plans_[i]);
  std::vector<std::pair<MovedLanding, const MovedLandings*>> all;
  for (const MovedLandings& guide : guides) {
    for (MovedLanding& landing : guide.proposals()) all.emplace_back(std::move(landing), &guide);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first.worth > b.first.worth; });
  for (const auto& [landing, guide] : all) {
    if (enough()) return;
    std::optional<Plan> plan = guide->moved(landing);
    if (plan && plan->score >= leastScore) addIfNew(*plan);
  }
}

}  // namespace ifa
