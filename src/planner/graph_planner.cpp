// SPDX-License-Identifier: Apache-2.0
#include "planner/graph_planner.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/stopwatch.h"
#include "planner/check_request.h"
#include "planner/graph_plan.h"
#include "planner/orientation_wishes.h"
#include "planner/plan_difference.h"

namespace ifa {

namespace {

/// Plans found so far, best first, no two the same.
class Found {
 public:
  explicit Found(const PlanRequest& request)
      : wanted_(static_cast<std::size_t>(std::max(1, request.settings.takes))),
        group_(request.symmetry) {}

  void add(Plan plan) {
    const auto worse = std::find_if(plans_.begin(), plans_.end(),
                                    [&](const Plan& other) { return plan.score > other.score; });
    const auto same = [this](const Plan& a) {
      return [this, &a](const Plan& b) { return !differentTakes(a, b, group_); };
    };
    if (std::any_of(plans_.begin(), worse, same(plan))) return;
    const auto at = plans_.insert(worse, std::move(plan));
    plans_.erase(std::remove_if(at + 1, plans_.end(), same(*at)), plans_.end());
    if (plans_.size() > wanted_) plans_.resize(wanted_);
  }
  [[nodiscard]] bool reached(double score) const {
    return !plans_.empty() && plans_[0].score >= score;
  }
  [[nodiscard]] bool any() const { return !plans_.empty(); }
  [[nodiscard]] bool full() const { return plans_.size() >= wanted_; }
  [[nodiscard]] std::vector<Plan> take() { return std::move(plans_); }

 private:
  std::size_t wanted_;
  const std::vector<Eigen::Matrix3d>& group_;
  std::vector<Plan> plans_;
};

/// One call of plan().
class GraphRun {
 public:
  GraphRun(const PlanRequest& request, const GraphPlannerSettings& settings,
           const Progress& progress)
      : request_(request),
        settings_(settings),
        progress_(progress),
        connector_(request),
        found_(request) {}

  std::vector<Plan> run() {
    request_.signature.events.size() == 1 ? runSingle() : runSearch();
    std::vector<Plan> plans = found_.take();
    if (plans.empty()) plans.push_back(partial());
    for (Plan& plan : plans) {
      plan.timeLimitReached = cut_;
      plan.secondsToGoodScore = secondsToGood_;
    }
    return plans;
  }

 private:
  bool stop() {
    const double limit = request_.settings.timeLimitSeconds;
    if (limit > 0 && watch_.seconds() > limit) cut_ = true;
    return cut_ || progress_.stopRequested();
  }
  void keep(const GraphPath& path) {
    Plan plan = planOf(request_, path, connector_);
    plan.solved = true;
    if (!OrientationWishes::met(plan) || !request_.accepted(plan)) return;
    found_.add(std::move(plan));
    if (secondsToGood_ < 0 && found_.reached(kGoodScore)) secondsToGood_ = watch_.seconds();
  }

  /// An event, and the motion that comes to it (5.5).
  void runSingle() {
    const SignatureEvent& only = request_.signature.events[0];
    constexpr std::size_t kTries = 16;      // of which some may be the same take
    constexpr std::size_t kOriented = 512;  // of which few lie as asked
    const std::size_t count = static_cast<std::size_t>(request_.settings.takes) *
                              (request_.orientations.empty() ? kTries : kOriented);
    for (const PathEnd& end :
         request_.graph->bestAlone(heardOf(only), request_.signature.terminal, count)) {
      GraphPath path;
      path.first = end.event;
      path.firstAmplitude = request_.graph->event(end.event).amplitude;
      keep(path);
    }
  }

  void runSearch() {
    GraphSearch search(request_, settings_, connector_, [this] { return stop(); });
    search.progress = [this](double share) { progress_("search", share); };
    while (!(found_.full() && found_.reached(request_.settings.earlyExit))) {
      const auto path = search.next();
      if (!path) break;
      keep(*path);
    }
    if (!found_.any() && !progress_.stopRequested()) search.reachFarthest();
    farthest_ = search.farthest();
    // A complete one may have been found only then.
    if (!found_.any() && isComplete(farthest_)) keep(farthest_);
  }

  [[nodiscard]] bool isComplete(const GraphPath& path) const {
    return path.last() + 1 == static_cast<int>(request_.signature.events.size());
  }

  Plan partial() {
    Plan plan;
    if (!farthest_.edges.empty()) plan = planOf(request_, farthest_, connector_);
    plan.failure = failure();
    if (cut_) plan.failure = "the time limit was reached; " + plan.failure;
    return plan;
  }

  [[nodiscard]] std::string failure() const {
    const auto& events = request_.signature.events;
    const auto next = static_cast<std::size_t>(farthest_.last()) + 1;
    if (next >= events.size()) {
      return request_.orientations.empty()
                 ? "no path through the database was found"
                 : "no path through the database was found that lies as --orient asks";
    }
    return fmt::format(
        "contact {} at {:.3f} s cannot be met: no transition of the database leads there, {:.0f} "
        "ms after the contact before; a larger database, another restitution, or a mark that was "
        "missed or is false?",
        next + 1, events[next].time, 1e3 * (events[next].time - events[next - 1].time));
  }

  const PlanRequest& request_;
  const GraphPlannerSettings& settings_;
  const Progress& progress_;
  Stopwatch watch_{request_.settings.timeOf};
  PathConnector connector_;
  Found found_;
  GraphPath farthest_;
  double secondsToGood_ = -1;
  bool cut_ = false;
};

}  // namespace

Result<std::vector<Plan>> GraphPlanner::plan(const PlanRequest& request,
                                             const Progress& progress) const {
  if (const auto good = checkRequest(request); !good) return tl::unexpected(good.error());
  if (request.graph == nullptr) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "the graph planner needs an event database",
                                  "--database", "build one with ifa database build"});
  }
  std::vector<Plan> plans = GraphRun(request, settings_, progress).run();
  if (progress.stopRequested() && !plans[0].solved) {
    return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
  }
  return plans;
}

}  // namespace ifa
