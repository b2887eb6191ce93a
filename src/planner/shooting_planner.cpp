// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_planner.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/stopwatch.h"
#include "planner/check_request.h"
#include "planner/plan_difference.h"
#include "planner/shooting_plan.h"
#include "planner/shooting_search.h"

namespace ifa {

namespace {

/// A plan below this Score is not called solved (docs/method.md 5).
constexpr double kLeastScore = 0.5;

bool acceptable(const ShootingProblem& problem, const ShootingNode& node) {
  return node.log.score(static_cast<int>(problem.targets.size())) >= kLeastScore;
}

/// Gathers takes over the passes.
class Takes {
 public:
  explicit Takes(const ShootingProblem& problem) : problem_(problem) {}

  void add(const ShootingSearch& search) {
    const auto wanted = static_cast<std::size_t>(problem_.request.settings.takes);
    std::vector<Plan> found = std::move(plans_);
    for (const ShootingNode& node : search.complete()) {
      if (!acceptable(problem_, node)) break;
      found.push_back(planOf(problem_, search.path(node)));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Plan& a, const Plan& b) { return a.worth > b.worth; });
    plans_.clear();
    for (Plan& plan : found) {
      const bool isNew = std::all_of(plans_.begin(), plans_.end(), [&](const Plan& other) {
        return differentTakes(plan, other, problem_.request.symmetry);
      });
      if (!isNew || plans_.size() >= wanted) continue;
      if (isAccepted(plan)) plans_.push_back(std::move(plan));
    }
  }
  [[nodiscard]] bool enough() const {
    return plans_.size() >= static_cast<std::size_t>(problem_.request.settings.takes);
  }
  [[nodiscard]] std::vector<Plan>& plans() { return plans_; }
  [[nodiscard]] bool refused() const { return refused_ > 0; }

 private:
  /// Those of earlier passes have been.
  bool isAccepted(Plan& plan) {
    constexpr int kMostRefused = 20;
    if (plan.solved) return true;
    if (refused_ == kMostRefused) return false;
    plan.solved = true;
    plan.bendCap = problem_.request.settings.bendCap;
    if (problem_.request.accepted(plan)) return true;
    ++refused_;
    return false;
  }

  const ShootingProblem& problem_;
  std::vector<Plan> plans_;
  int refused_ = 0;
};

/// How much work is left for more takes than one: all of them cost at most twice what one does.
/// Work is counted in widths of passes.
class TakesBudget {
 public:
  [[nodiscard]] double width(double planned) const {
    return price_ > 0 ? std::min(planned, left()) : planned;
  }
  [[nodiscard]] bool spent() const { return price_ > 0 && left() < kNarrowest; }
  /// One pass more. @param one  whether a single take would be settled by now
  void count(double width, bool one) {
    work_ += width;
    if (one && price_ == 0) price_ = work_;
  }

 private:
  static constexpr double kNarrowest = 0.25;
  [[nodiscard]] double left() const { return 2 * price_ - work_; }
  double work_ = 0, price_ = 0;
};

/// One call of plan().
class ShootingRun {
 public:
  ShootingRun(const PlanRequest& request, const ShootingPlannerSettings& settings,
              const Progress& progress)
      : request_(request),
        settings_(settings),
        progress_(progress),
        problem_(request, settings),
        takes_(problem_),
        hard_(problem_.targets.size(), false) {}

  Result<std::vector<Plan>> run() {
    // A budget of less than one pass makes that pass narrower.
    const double budget = settings_.passes * request_.settings.effort;
    const int passes = std::max(1, static_cast<int>(std::lround(budget)));
    const double width = std::min(1.0, budget);
    for (int pass = 0; pass < passes && !work_.spent() && !stop(); ++pass) {
      if (!goesOn(pass, passes, work_.width(std::min(settings_.widest, width + 0.5 * pass)))) break;
    }
    if (progress_.stopRequested() && takes_.plans().empty()) {
      return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
    }
    return plans();
  }

 private:
  bool stop() {
    const double limit = request_.settings.timeLimitSeconds;
    if (limit > 0 && watch_.seconds() > limit) cut_ = true;
    return cut_ || progress_.stopRequested();
  }

  /// Makes a pass; whether another one may help.
  bool goesOn(int pass, int passes, double wide) {
    ShootingSearch search(problem_, static_cast<std::uint64_t>(pass), wide, hard_);
    search.run([this] { return stop(); },
               [&](double share) { progress_("search", (pass + share) / passes); });
    takes_.add(search);
    const bool found = !takes_.plans().empty();
    if (!found && !learnsFrom(search) && pass > 0) return false;
    const bool one = found && (pass > 0 || isGood(takes_.plans()[0]));
    work_.count(wide, one);
    return !(one && takes_.enough());
  }

  [[nodiscard]] bool isGood(const Plan& plan) const {
    return plan.score >= settings_.goodScore && plan.bendMax <= settings_.goodBend;
  }

  /// Keeps the best partial motion, and where the search did not get on. False where luck does not
  /// matter: other seeds meet the second contact no better.
  bool learnsFrom(const ShootingSearch& search) {
    const ShootingNode* farthest = search.farthest();
    Plan plan;
    if (farthest != nullptr) {
      plan = planOf(problem_, search.path(*farthest));
      for (int k = 0; k < settings_.hardContacts; ++k) {
        hard_[static_cast<std::size_t>(std::max(0, farthest->level - k))] = true;
      }
    }
    plan.failure = takes_.refused() ? "no motion that was found holds its audit"
                                    : failureOf(problem_, search, farthest, kLeastScore);
    partial_.push_back(std::move(plan));
    return farthest != nullptr && (farthest->level > 0 || problem_.targets.size() == 1);
  }

  std::vector<Plan> plans() {
    std::vector<Plan> plans = std::move(takes_.plans());
    if (plans.empty()) {
      const auto longest = std::max_element(
          partial_.begin(), partial_.end(),
          [](const Plan& a, const Plan& b) { return a.contacts.size() < b.contacts.size(); });
      plans.push_back(longest != partial_.end() ? *longest : Plan{});
      if (cut_) plans[0].failure = "the time limit was reached; " + plans[0].failure;
    }
    for (Plan& plan : plans) {
      plan.timeLimitReached = cut_;
      plan.bendCap = request_.settings.bendCap;
    }
    return plans;
  }

  const PlanRequest& request_;
  const ShootingPlannerSettings& settings_;
  const Progress& progress_;
  Stopwatch watch_;
  std::atomic<bool> cut_ = false;
  ShootingProblem problem_;
  Takes takes_;
  TakesBudget work_;
  std::vector<bool> hard_;  ///< ShootingSearch's
  std::vector<Plan> partial_;
};

}  // namespace

Result<std::vector<Plan>> ShootingPlanner::plan(const PlanRequest& request,
                                                const Progress& progress) const {
  if (const auto good = checkRequest(request); !good) return tl::unexpected(good.error());
  if (settings_.aimedEvents > 0 && request.database == nullptr) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "the hybrid planner needs an event database",
                                  "--database", "build one with ifa database build"});
  }
  progress("learn", 0);
  return ShootingRun(request, settings_, progress).run();
}

}  // namespace ifa
