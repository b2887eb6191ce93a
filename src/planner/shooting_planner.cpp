// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_planner.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "base/stopwatch.h"
#include "planner/check_request.h"
#include "planner/shooting_plan.h"
#include "planner/shooting_search.h"
#include "planner/shooting_takes.h"
#include "planner/take_lineages.h"

namespace ifa {

namespace {

/// What all takes together may cost in work, where one costs 1. It is not all of twice the price,
/// since what is counted does not always take the same time.
constexpr double kPrice = 1.75;
/// Of a pass, at least so much is made for further takes.
constexpr double kNarrowestPass = 0.25;
/// Searches that go on from a pass are by so much narrower, and find little below the second.
constexpr double kNarrower = 0.5, kNarrowest = 0.12;
/// With time warped, as much work takes so many times as long.
constexpr double kWarpedCost = 1.3;
/// Where nothing is found, so many searches of these widths go on from each pass, with so many
/// different ways.
constexpr std::array kLastWidths = {0.5, 1.0};
constexpr int kLastRounds = 3;
constexpr std::size_t kLastWays = 12;
/// The last contacts but one are too late to find another way to rest.
constexpr std::size_t kTooLate = 2;

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
        work_(kPrice),
        hard_(problem_.targets.size(), false) {}

  Result<std::vector<Plan>> run() {
    // A budget of less than one pass makes that pass narrower.
    const double budget = settings_.passes * request_.settings.effort;
    const int passes = std::max(1, static_cast<int>(std::lround(budget)));
    const double width = std::min(1.0, budget);
    most_ = settings_.mostPieces * request_.settings.effort;
    for (int pass = 0; pass < passes && !stop(); ++pass) {
      // Further takes have a price of their own.
      const bool more = request_.settings.takes > 1 && found();
      if (!more && static_cast<double>(pieces_) > most_) break;
      const double wide = work_.width(std::min(settings_.widest, width + 0.5 * pass));
      if ((work_.priced() && wide < kNarrowestPass) || !goesOn(pass, passes, wide)) break;
    }
    if (request_.settings.warpsAtLast && !found()) warpAtLast();
    // What is moved would not be where it is asked to be.
    const bool moves = request_.positions.empty();
    if (moves && !takes_.plans().empty() && !takes_.enough() && !stop()) takes_.move();
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

  /// Whether there is a plan that is near enough to all places that are asked for.
  bool found() { return !takes_.plans().empty() && PositionWishes::met(takes_.plans()[0]); }

  void tell(double share) {
    told_ = std::clamp(share, told_, 1.0);
    progress_(stage_, told_);
  }

  /// Tells how far the passes are, by their number, by what they may simulate, by which what is
  /// hard ends, or by the takes that there are.
  void tell(const ShootingSearch& running, double passes) {
    const double pieces = static_cast<double>(pieces_ + running.work().pieces);
    const int wanted = request_.settings.takes;
    const double takes = wanted > 1 ? static_cast<double>(takes_.plans().size()) / wanted : 0;
    tell(std::min(1.0, std::max({passes, pieces / most_, takes})));
  }

  /// Makes a pass; whether another one may help.
  bool goesOn(int pass, int passes, double wide) {
    ShootingSearch search(problem_, static_cast<std::uint64_t>(pass), wide, hard_);
    search.run([this] { return stop(); },
               [&](double share) { tell(search, (pass + share) / passes); });
    pieces_ += search.work().pieces;
    work_.count(search.work().cost());
    takes_.add(search);
    for (int i = 0; i < settings_.again && !found() && !stop(); ++i) {
      work_.count(searchAgain(search, wide));
    }
    // With warped time what is found first is taken.
    const bool warps = request_.settings.timeWarp > 0;
    if (warps && !found()) warpOn(problem_, search, kLastWidths.front());
    if (!found()) {
      const bool luck = !takes_.plans().empty() || learnsFrom(search);
      if (!luck && pass > 0) return false;
      work_.passed(wide, false);
      if (request_.settings.warpsAtLast) failed_.push_back(std::move(search));
      return true;
    }
    const bool one = pass > 0 || warps || isGood(takes_.plans()[0]);
    work_.passed(wide, one);
    if (one && takes_.missing() > 0) resume(search, wide);
    return !(one && takes_.missing() == 0);
  }

  /// Goes on with other random numbers from a little before the contact that the pass did not get
  /// past: what came before that is not paid for again.
  double searchAgain(const ShootingSearch& search, double wide) {
    const ShootingNode* farthest = search.farthest();
    if (farthest == nullptr || farthest->level <= settings_.againFrom) return 0;
    const auto level = static_cast<std::size_t>(farthest->level - settings_.againFrom);
    return goOn(problem_, search, wide, {level, search.kept(level), false});
  }

  /// Searches on from what the pass kept, with other random numbers. Returns what it costs.
  double goOn(const ShootingProblem& problem, const ShootingSearch& search, double wide,
              ShootingSearch::Beginning beginning) {
    ShootingSearch more(problem, search, kResumed + resumed_++, wide, std::move(beginning));
    more.run([this] { return stop(); },
             [&](double share) {
               if (lastSearches_ == 0) return tell(more, 0);
               tell((lastSearch_ + share) / lastSearches_);
             });
    pieces_ += more.work().pieces;
    takes_.add(more);
    return more.work().cost();
  }

  /// The same request with time warped.
  [[nodiscard]] PlanRequest warpedRequest() const {
    PlanRequest request = request_;
    request.settings.timeWarp = std::max(request.settings.timeWarp, kEasedWarp);
    return request;
  }

  /// Where all passes found nothing: goes on from each with time warped, the last one first.
  void warpAtLast() {
    const PlanRequest request = warpedRequest();
    const ShootingProblem warped(problem_, request);
    lastSearches_ = static_cast<int>(kLastWidths.size() * failed_.size()) * kLastRounds;
    stage_ = "search on";
    told_ = 0;
    int first = 0;
    for (const double width : kLastWidths) {
      for (auto search = failed_.rbegin(); search != failed_.rend(); ++search) {
        lastSearch_ = first;
        first += kLastRounds;
        warpOn(warped, *search, width);
      }
    }
  }

  /// From ever earlier, until something is found.
  void warpOn(const ShootingProblem& warped, const ShootingSearch& search, double width) {
    const ShootingNode* farthest = search.farthest();
    std::size_t before = farthest != nullptr ? static_cast<std::size_t>(farthest->level) : 0;
    for (int round = 0; round < kLastRounds && !found() && !stop(); ++round, ++lastSearch_) {
      TakeLineages lineages = lineagesBeside({}, search, kLastWays, before);
      if (lineages.ways == 0) return;
      before = lineages.beginning.level;
      goOn(warped, search, width, lineages.beginning);
      // What a narrow search comes upon is seldom the best.
      if (found() && !isGood(takes_.plans()[0])) {
        goOn(warped, search, kLastWidths.back(), std::move(lineages.beginning));
      }
    }
  }

  /// Goes on from where the pass had motions that would make other takes, with time warped: first
  /// beside those that were found, then from those as well, then from earlier.
  void resume(const ShootingSearch& search, double wide) {
    const PlanRequest request = warpedRequest();
    ShootingProblem warped(problem_, request);
    // It counts in full here: a further take is missed less than a motion.
    warped.settings.warpWeight = 1;
    const std::size_t last = search.levels() > kTooLate ? search.levels() - kTooLate : 0;
    std::size_t before = last;
    bool beside = true;
    while (takes_.missing() > 0 && !stop()) {
      const std::size_t missing = takes_.missing(), found = takes_.plans().size();
      TakeLineages lineages = lineagesBeside(beside ? takes_.plans() : std::vector<Plan>{}, search,
                                             settings_.waysPerTake * missing, before);
      const std::size_t level = lineages.beginning.level;
      const double full = kWarpedCost * search.costFrom(level);
      const double width = std::min(kNarrower, work_.left() / full);
      if (lineages.ways == 0 || width < kNarrowest) return;
      work_.count(kWarpedCost * goOn(warped, search, width * wide, std::move(lineages.beginning)));
      if (takes_.missing() < missing || takes_.plans().size() > found) continue;
      if (!beside) before = level;
      beside = !beside;
    }
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
  /// Numbers of searches that go on from a pass, among those of passes.
  static constexpr std::uint64_t kResumed = 1000;
  std::uint64_t resumed_ = 0;
  long pieces_ = 0;  ///< simulated so far
  double most_ = 0;  ///< pieces after which no other pass begins
  const char* stage_ = "search";
  double told_ = 0;     ///< share of the stage
  int lastSearch_ = 0;  ///< of lastSearches_, where all passes found nothing; 0 before
  int lastSearches_ = 0;
  std::vector<bool> hard_;  ///< ShootingSearch's
  std::vector<Plan> partial_;
  std::vector<ShootingSearch> failed_;  ///< kept to be gone on with
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
