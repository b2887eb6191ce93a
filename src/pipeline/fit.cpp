// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/stopwatch.h"
#include "pipeline/learned.h"
#include "planner/shooting_planner_settings.h"

namespace ifa {

namespace {

constexpr double kOff = 0.7;    ///< the right restitution over the given one, or inverse
constexpr double kStep = 0.02;  ///< restitutions are multiples, so that caches serve again
constexpr double kNear = 0.1, kBeside = 0.1;  ///< relative, of a second restitution
constexpr double kEnough = 0.95;        ///< a first look with this Score is not followed by others
constexpr std::size_t kWholePlans = 3;  ///< at most
/// Work, in shares of what one plan may cost: all first looks together cost two passes, and
/// a whole plan one pass less than it would alone, unless it is at the given restitution.
constexpr double kOnePass = 1.0 / ShootingPlannerSettings().passes;

double onGrid(double restitution, const RestitutionRange& range) {
  return std::clamp(std::round(restitution / kStep) * kStep, range.least, range.most);
}

/// A plan that may be the one.
struct Attempt {
  FitCandidate candidate;
  PlanRequest request;
  std::vector<Plan> plans;

  [[nodiscard]] const Plan& best() const { return plans.front(); }
};

bool better(const Attempt& one, const Attempt& other) {
  const Plan &a = one.best(), &b = other.best();
  if (a.solved != b.solved) return a.solved;
  if (!a.solved && a.contacts.size() != b.contacts.size()) {
    return a.contacts.size() > b.contacts.size();
  }
  return a.score > b.score;
}

class Fitting {
 public:
  Fitting(const FitRequest& request, const Progress& progress)
      : request_(request), progress_(progress) {}

  Result<Fit> run() {
    const auto candidates = fitCandidates(request_, quiet());
    if (auto good = look(candidates); !good) return tl::unexpected(good.error());
    if (!lookIsEnough()) {
      if (auto good = planWhole(order(candidates)); !good) return tl::unexpected(good.error());
    }
    tellWhatWasTried();
    return Fit{best_->request, best_->candidate.surface,
               request_.surfaces.at(best_->candidate.surface).restitution, std::move(best_->plans)};
  }

 private:
  /// Stops as ours, says nothing.
  [[nodiscard]] Progress quiet() const {
    Progress inner;
    inner.stop = progress_.stop;
    return inner;
  }

  /// Seconds left; nothing where there is no limit.
  [[nodiscard]] std::optional<double> secondsLeft() const {
    const double limit = request_.plan.settings.timeLimitSeconds;
    if (limit <= 0) return {};
    return limit - watch_.seconds();
  }
  [[nodiscard]] bool over() const {
    return progress_.stopRequested() || (best_ && secondsLeft().value_or(1) <= 0);
  }

  Result<void> attempt(const FitCandidate& candidate, double effort, int takes,
                       const Progress& progress) {
    PlanRequest plan = request_.plan;
    plan.surface = request_.surfaces.at(candidate.surface);
    plan.surfaceName = candidate.surface;
    plan.surface.restitution = candidate.restitution;
    plan.outlook = learnObject(*plan.body, plan.surface, request_.cache, quiet()).outlook;
    plan.settings.effort *= effort;
    plan.settings.takes = takes;
    if (const auto left = secondsLeft()) plan.settings.timeLimitSeconds = std::max(1e-3, *left);
    auto plans = request_.planner->plan(plan, progress);
    if (!plans) {
      const bool kept = best_ && best_->best().solved && progress_.stopRequested();
      return kept ? Result<void>{} : tl::unexpected(plans.error());
    }
    plan.settings = request_.plan.settings;
    tried_.push_back(candidate);
    Attempt found{candidate, plan, std::move(*plans)};
    if (!best_ || !better(*best_, found)) best_ = found;
    looks_.push_back(std::move(found));
    return {};
  }

  Result<void> look(const std::vector<FitCandidate>& candidates) {
    const auto count = static_cast<double>(candidates.size());
    const double effort = kOnePass * std::min(1.0, 2 / count);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      progress_("fit", static_cast<double>(i) / count);
      if (auto good = attempt(candidates[i], effort, 1, quiet()); !good) return good;
      if (over() || (best_->best().solved && best_->best().score >= kEnough)) break;
    }
    progress_("fit", 1);
    return {};
  }

  /// Of several takes only the first was looked for.
  [[nodiscard]] bool lookIsEnough() const {
    return over() || (request_.plan.settings.takes == 1 && isGood(best_->best()));
  }
  [[nodiscard]] static bool isGood(const Plan& plan) {
    return plan.solved && plan.score >= ShootingPlannerSettings().goodScore;
  }

  /// Those that get a whole plan: best look first, then the others, and what was given, so that
  /// a fit comes out no worse than what is planned without it.
  [[nodiscard]] std::vector<FitCandidate> order(const std::vector<FitCandidate>& candidates) {
    std::stable_sort(looks_.begin(), looks_.end(), better);
    std::vector<FitCandidate> all;
    const auto add = [&](const FitCandidate& candidate) {
      const bool there = std::any_of(all.begin(), all.end(), [&](const FitCandidate& other) {
        return other.surface == candidate.surface && other.restitution == candidate.restitution;
      });
      if (!there) all.push_back(candidate);
    };
    for (const Attempt& look : looks_) add(look.candidate);
    for (const FitCandidate& candidate : candidates) add(candidate);
    const auto given = std::find_if(all.begin(), all.end(),
                                    [this](const FitCandidate& one) { return isGiven(one); });
    if (static_cast<std::size_t>(given - all.begin()) >= kWholePlans) all.resize(kWholePlans - 1);
    add({request_.first, request_.surfaces.at(request_.first).restitution});
    return all;
  }

  [[nodiscard]] bool isGiven(const FitCandidate& one) const {
    return one.surface == request_.first &&
           one.restitution == request_.surfaces.at(request_.first).restitution;
  }

  Result<void> planWhole(const std::vector<FitCandidate>& candidates) {
    const std::size_t count = std::min(kWholePlans, candidates.size());
    for (std::size_t i = 0; i < count && !over(); ++i) {
      if (i > 0 && isGood(best_->best())) break;
      Progress inner = progress_;
      inner.report = [&](std::string_view stage, double share) {
        const double all = (static_cast<double>(i) + share) / static_cast<double>(count);
        if (stage == "search") progress_(stage, all);
      };
      const double effort = isGiven(candidates[i]) ? 1 : 1 - kOnePass;
      const auto good = attempt(candidates[i], effort, request_.plan.settings.takes, inner);
      if (!good) return good;
    }
    return {};
  }

  void tellWhatWasTried() {
    if (secondsLeft().value_or(1) <= 0) {
      for (Plan& plan : best_->plans) plan.timeLimitReached = true;
    }
    Plan& plan = best_->plans.front();
    if (plan.solved) return;
    const auto [least, most] = std::minmax_element(
        tried_.begin(), tried_.end(),
        [](const auto& a, const auto& b) { return a.restitution < b.restitution; });
    plan.failure += fmt::format("; restitutions from {:.2f} to {:.2f} were tried",
                                least->restitution, most->restitution);
  }

  const FitRequest& request_;
  const Progress& progress_;
  Stopwatch watch_;
  std::vector<Attempt> looks_;
  std::optional<Attempt> best_;
  std::vector<FitCandidate> tried_;
};

/// What `signature` sounds like on this surface.
double soundsLike(const FitRequest& request, const SurfaceProperties& surface,
                  const Progress& progress) {
  const double given = surface.restitution;
  if (request.plan.signature.events.size() < 2) return given;
  const RestitutionOutlook outlook =
      learnRestitution(*request.plan.body, surface, request.cache, progress);
  return onGrid(outlook.estimate(request.plan.signature), fitRange(given));
}

}  // namespace

RestitutionRange fitRange(double given) {
  return {given * kOff, std::max(given * kOff, std::min(kMostRestitution, given / kOff))};
}

void changeRestitution(const SynchronizeSettings& settings, ObjectDefinition& object) {
  if (!settings.restitution && settings.restitutionScale == 1) return;
  for (auto& [name, surface] : object.surfaces) {
    const double scaled = settings.restitutionScale * surface.restitution;
    surface.restitution = settings.restitution.value_or(std::min(kMostRestitution, scaled));
  }
}

std::vector<FitCandidate> fitCandidates(const FitRequest& request, const Progress& progress) {
  std::vector<FitCandidate> candidates;
  const SurfaceProperties& first = request.surfaces.at(request.first);
  candidates.push_back({request.first, soundsLike(request, first, progress)});
  for (const auto& [name, surface] : request.surfaces) {
    if (name != request.first) candidates.push_back({name, soundsLike(request, surface, progress)});
  }
  if (candidates.size() > 1) return candidates;
  const double given = first.restitution, guess = candidates[0].restitution;
  const bool near = std::abs(guess - given) <= kNear * given;
  // Beyond the estimate, which is pulled towards the middle of what it was learnt from; back from
  // the end of the range.
  const RestitutionRange range = fitRange(given);
  const bool up = guess >= range.most ? false : guess <= range.least || guess > given;
  const double second = near ? given : onGrid(guess * (up ? 1 + kBeside : 1 - kBeside), range);
  if (second != guess) candidates.push_back({request.first, second});
  return candidates;
}

Result<Fit> planWithFit(const FitRequest& request, const Progress& progress) {
  return Fitting(request, progress).run();
}

}  // namespace ifa
