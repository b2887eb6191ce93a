// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "planner/check_request.h"
#include "planner/plan_difference.h"
#include "planner/shooting_search.h"

namespace ifa {

namespace {

using Clock = std::chrono::steady_clock;

PlannedContact contactOf(const ShootingNode& node) {
  PlannedContact contact;
  contact.event = node.event;
  contact.time = node.start;
  contact.restitution = node.restitution;
  contact.relativeAmplitude = node.heard.amplitude;
  contact.bend = node.bend;
  contact.arrival = node.arrival;
  contact.arrivalChange = node.arrivalChange;
  contact.arrivalAngularChange = node.arrivalAngular;
  contact.arrivalBend = node.arrivalBend;
  contact.source = node.source;
  if (node.level == 0 && node.source.kind == SourceKind::kShot) {
    contact.source.kind = SourceKind::kSampled;
  }
  return contact;
}

/// The factors of a contact, from its own numbers.
ContactFactors factorsOf(const ShootingNode& node, const HeardEvent& target) {
  ContactFactors factors;
  factors.v = std::exp(logVelocity(node.bend) + logVelocity(node.arrivalBend));
  factors.a = std::exp(logAmplitude(target, node.heard));
  factors.l = std::exp(logDuration(target, node.heard));
  factors.c = std::exp(logCentroid(target, node.heard));
  return factors;
}

Plan planOf(const ShootingProblem& problem, const std::vector<ShootingNode>& path) {
  Plan plan;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const ShootingNode& node = path[i];
    PlannedContact contact = contactOf(node);
    contact.factors = factorsOf(node, problem.targets[static_cast<std::size_t>(node.level)]);
    contact.target = node.level;
    if (i > 0) {
      plan.contacts.back().velocityChange = node.velocityChange;
      plan.contacts.back().angularVelocityChange = node.angularChange;
    }
    plan.contacts.push_back(contact);
  }
  sumUp(plan, path.back().log);
  return plan;
}

/// A plan below this Score is not called solved (docs/method.md 5).
constexpr double kLeastScore = 0.5;

bool acceptable(const ShootingProblem& problem, const ShootingNode& node) {
  return node.log.score(static_cast<int>(problem.targets.size())) >= kLeastScore;
}

/// The commonest reason for which no motion reached the next contact, and what would help.
std::string reasonOf(const ShootingDeaths& d, double gap, bool terminal) {
  const long flight = d.noFlight + d.bent + d.energy + d.earlier;
  const long sum = flight + d.unheard + d.restless + d.noTime;
  if (sum == 0) return "the search ended before it was tried";
  if (d.noTime * 2 > sum) {
    return fmt::format("{:.0f} ms leave no time after the contact before; merge the two labels",
                       gap * 1e3);
  }
  if (terminal && d.restless > flight) {
    return "no motion comes to rest there; a longer last label, or --no-terminal, would help";
  }
  if (d.unheard * 2 > sum)
    return "the contact would be too soft to be heard; another object or surface?";
  if (d.energy > d.earlier && d.energy * 3 > sum) {
    return fmt::format(
        "the gap of {:.0f} ms before it needs more energy than is left; a higher restitution or a "
        "mark that was missed in the gap?",
        gap * 1e3);
  }
  if (d.bent > d.earlier) {
    return fmt::format(
        "a gap of {:.0f} ms asks for an implausible bounce; another restitution, or a missed or "
        "false mark near it?",
        gap * 1e3);
  }
  return fmt::format(
      "in the {:.0f} ms before it something always touches too early; a mark that was "
      "missed there?",
      gap * 1e3);
}

std::string failureOf(const ShootingProblem& problem, const ShootingSearch& search,
                      const ShootingNode* farthest) {
  const auto& events = problem.request.signature.events;
  if (farthest == nullptr) {
    return events.size() == 1 && problem.request.signature.terminal
               ? "contact 1 at 0.000 s: no motion comes to rest in one contact like this"
               : "contact 1 at 0.000 s: no initial state gives an audible contact";
  }
  const auto level = static_cast<std::size_t>(farthest->level);
  if (level + 1 >= events.size()) {
    return fmt::format(
        "the best motion's Score is {:.2f}, under {:.1f}: marks or object do not fit",
        farthest->log.score(static_cast<int>(events.size())), kLeastScore);
  }
  const bool terminal = level + 2 == events.size() && problem.request.signature.terminal;
  return fmt::format("contact {} at {:.3f} s cannot be met: {}", level + 2, events[level + 1].time,
                     reasonOf(search.deathsAfter(farthest->level),
                              events[level + 1].time - events[level].time, terminal));
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
                     [](const Plan& a, const Plan& b) { return a.score > b.score; });
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

}  // namespace

Result<std::vector<Plan>> ShootingPlanner::plan(const PlanRequest& request,
                                                const Progress& progress) const {
  if (const auto good = checkRequest(request); !good) return tl::unexpected(good.error());
  if (settings_.aimedEvents > 0 && request.database == nullptr) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "the hybrid planner needs an event database",
                                  "--database", "build one with ifa database build"});
  }
  const auto begin = Clock::now();
  const double limit = request.settings.timeLimitSeconds;
  const auto late = [&] {
    return limit > 0 && std::chrono::duration<double>(Clock::now() - begin).count() > limit;
  };
  std::atomic<bool> cut = false;
  const auto stop = [&] {
    if (late()) cut = true;
    return cut || progress.stopRequested();
  };
  progress("learn", 0);
  const ShootingProblem problem(request, settings_);
  Takes takes(problem);
  std::vector<Plan> partial;
  // A budget of less than one pass makes that pass narrower.
  const double budget = settings_.passes * request.settings.effort;
  const int passes = std::max(1, static_cast<int>(std::lround(budget)));
  const double width = std::min(1.0, budget);
  TakesBudget work;
  std::vector<bool> hard(problem.targets.size(), false);
  for (int pass = 0; pass < passes && !work.spent() && !stop(); ++pass) {
    const double wide = work.width(width + 0.5 * pass);
    ShootingSearch search(problem, static_cast<std::uint64_t>(pass), wide, hard);
    search.run(stop, [&](double share) { progress("search", (pass + share) / passes); });
    takes.add(search);
    if (takes.plans().empty()) {
      const ShootingNode* farthest = search.farthest();
      Plan plan;
      if (farthest != nullptr) {
        plan = planOf(problem, search.path(*farthest));
        for (int k = 0; k < settings_.hardContacts; ++k) {
          hard[static_cast<std::size_t>(std::max(0, farthest->level - k))] = true;
        }
      }
      plan.failure = takes.refused() ? "no motion that was found holds its audit"
                                     : failureOf(problem, search, farthest);
      partial.push_back(std::move(plan));
      // Other seeds meet the second contact no better; what can be done there does not depend on
      // luck.
      if (pass > 0 && (farthest == nullptr || (farthest->level == 0 && problem.targets.size() > 1)))
        break;
    }
    const bool one =
        !takes.plans().empty() && (pass > 0 || takes.plans()[0].score >= settings_.goodScore);
    work.count(wide, one);
    if (one && takes.enough()) break;
  }
  if (progress.stopRequested() && takes.plans().empty()) {
    return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
  }
  std::vector<Plan> plans = std::move(takes.plans());
  if (plans.empty()) {
    const auto longest = std::max_element(
        partial.begin(), partial.end(),
        [](const Plan& a, const Plan& b) { return a.contacts.size() < b.contacts.size(); });
    plans.push_back(longest != partial.end() ? *longest : Plan{});
    if (cut) plans[0].failure = "the time limit was reached; " + plans[0].failure;
  }
  for (Plan& plan : plans) {
    plan.timeLimitReached = cut;
    plan.bendCap = request.settings.bendCap;
  }
  return plans;
}

}  // namespace ifa
