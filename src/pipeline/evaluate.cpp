// SPDX-License-Identifier: Apache-2.0
#include "pipeline/evaluate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "audit/orientation_errors.h"
#include "base/stopwatch.h"
#include "pipeline/evaluation_places.h"
#include "pipeline/synchronize_with.h"
#include "sampler/paper_rows.h"

namespace ifa {
namespace {

constexpr double kSolvedScore = 0.5;      // method, 4
constexpr double kStartTolerance = 1e-4;  // s, likewise

/// The paper's planner may have any Score (method, 4).
bool isSolved(const Motion& motion, const std::string& planner, const CaseOutcome& outcome) {
  return motion.success && outcome.contacts == static_cast<int>(motion.contacts.size()) &&
         (planner == "graph" || outcome.score >= kSolvedScore) &&
         outcome.startError <= kStartTolerance && motion.bend.max <= motion.bend.cap;
}

std::string whyNot(const Motion& motion, const CaseOutcome& outcome) {
  if (outcome.solved) return {};
  if (!motion.failure.empty()) return motion.failure;
  if (outcome.score < kSolvedScore) return "the Score is under 0.5";
  return "a contact is missing, late or bent too much";
}

void judge(const Motion& motion, const std::string& planner, CaseOutcome& outcome) {
  outcome.score = motion.score;
  outcome.scoreWithoutSound = motion.scoreWithoutSound;
  outcome.meanFv = motion.meanFv;
  outcome.searchSeconds = motion.searchSeconds;
  outcome.restitution = motion.object.restitution;
  outcome.givenRestitution = motion.given ? motion.given->restitution : outcome.restitution;
  for (const MotionContact& contact : motion.contacts) {
    outcome.bends.push_back(contact.bend);
    outcome.arrivalBends.push_back(contact.arrivalBend);
    outcome.factors.push_back(contact.factors);
    outcome.startError = std::max(outcome.startError, std::abs(contact.time - contact.targetTime));
    if (contact.targetDuration > 0) {
      outcome.continuous.push_back(
          {contact.targetDuration, contact.duration, contact.targetCentroid, contact.centroid});
    }
  }
  if (!motion.trajectory.empty()) outcome.orientationErrors = orientationErrors(motion);
  if (motion.database) outcome.events = motion.database->events;
  outcome.goodSeconds = motion.secondsToGoodScore;
  outcome.solved = isSolved(motion, planner, outcome);
  outcome.failure = whyNot(motion, outcome);
}

SynchronizeSettings settingsFor(const EvaluateSettings& settings, const EvaluationCase& what) {
  SynchronizeSettings one;
  one.sound = what.sound;
  one.labels = what.labels;
  one.object = what.object;
  one.surface = what.surface;
  one.planner = settings.planner;
  one.graph = settings.graph;
  one.seed = settings.seed;
  one.timeLimitSeconds = settings.timeLimitSeconds;
  one.restitutionScale = settings.restitutionScale;
  one.fit = settings.fit;
  one.orientations = settings.orientations;
  return one;
}

CaseOutcome runCase(const EvaluateSettings& settings, const EvaluationCase& what, GraphShelf& shelf,
                    const Progress& progress) {
  CaseOutcome outcome;
  outcome.what = what;
  SynchronizeSettings one = settingsFor(settings, what);
  KnownPlaces places;
  if (!what.places.empty()) {
    auto read = readKnownPlaces(what.places);
    if (!read) {
      outcome.failure = read.error().text();
      outcome.done = true;
      return outcome;
    }
    places = std::move(*read);
    one.positions = wishesFor(places);
  }
  const Stopwatch watch;
  const auto found = synchronizeWith(one, shelf, progress);
  outcome.wallSeconds = watch.seconds();
  outcome.done = !progress.stopRequested();
  if (!found) {
    outcome.failure = found.error().text();
    return outcome;
  }
  outcome.contacts = static_cast<int>(found->signature.events.size());
  judge(found->takes.front(), settings.planner, outcome);
  if (!what.places.empty() && outcome.solved) {
    outcome.places = placeErrors(places, found->takes.front());
  }
  return outcome;
}

/// Takes cases in order, several threads at a time, and writes outcomes by index.
class CaseQueue {
 public:
  CaseQueue(const EvaluateSettings& settings, const std::vector<EvaluationCase>& cases,
            const Progress& progress, const std::function<void(const CaseOutcome&)>& tell)
      : settings_(settings),
        cases_(cases),
        progress_(progress),
        tell_(tell),
        shelf_(settings.graph, 0) {
    outcomes_.resize(cases.size());
  }

  std::vector<CaseOutcome> run() {
    std::vector<std::jthread> workers;
    for (int i = 1; i < settings_.jobs; ++i) workers.emplace_back([this] { work(); });
    work();
    workers.clear();  // waits
    return std::move(outcomes_);
  }

 private:
  void work() {
    Progress inner;  // the stages of one case say nothing about the whole
    inner.stop = progress_.stop;
    for (std::size_t i; (i = next_++) < cases_.size() && !progress_.stopRequested();) {
      CaseOutcome outcome = runCase(settings_, cases_[i], shelf_, inner);
      const std::lock_guard lock(mutex_);
      progress_("evaluate", static_cast<double>(++done_) / static_cast<double>(cases_.size()));
      if (tell_ && outcome.done) tell_(outcome);
      outcomes_[i] = std::move(outcome);
    }
  }

  const EvaluateSettings& settings_;
  const std::vector<EvaluationCase>& cases_;
  const Progress& progress_;
  const std::function<void(const CaseOutcome&)>& tell_;
  GraphShelf shelf_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::vector<CaseOutcome> outcomes_;
};

std::string rowName(const EvaluationCase& what) {
  return what.surface.empty() ? what.object : what.object + " (" + what.surface + ")";
}

/// Place in the paper's Table 1, from 1; 0 for what it has not.
std::ptrdiff_t placeInPaper(const CaseOutcome& outcome) {
  const PaperRow* row = paperRow(outcome.what.object, outcome.what.surface);
  return row == nullptr ? 0 : row - kPaperRows.data() + 1;
}

}  // namespace

Evaluation sumUp(EvaluateSettings settings, std::vector<CaseOutcome> cases) {
  Evaluation evaluation;
  evaluation.settings = std::move(settings);
  std::stable_sort(cases.begin(), cases.end(), [](const CaseOutcome& a, const CaseOutcome& b) {
    return placeInPaper(a) < placeInPaper(b);
  });
  evaluation.cases = std::move(cases);
  std::vector<CaseOutcome> group;
  for (std::size_t i = 0; i < evaluation.cases.size(); ++i) {
    group.push_back(evaluation.cases[i]);
    const std::string name = rowName(group.back().what);
    if (i + 1 < evaluation.cases.size() && rowName(evaluation.cases[i + 1].what) == name) continue;
    evaluation.rows.push_back(summarize(name, group));
    group.clear();
  }
  evaluation.total = summarize("all", evaluation.cases);
  return evaluation;
}

Result<Evaluation> evaluate(const EvaluateSettings& settings, const Progress& progress,
                            const std::function<void(const CaseOutcome&)>& tell) {
  const auto cases = findCases(settings);
  if (!cases) return tl::unexpected<Error>(cases.error());
  auto outcomes = CaseQueue(settings, *cases, progress, tell).run();
  std::erase_if(outcomes, [](const CaseOutcome& outcome) { return !outcome.done; });
  Evaluation evaluation = sumUp(settings, std::move(outcomes));
  evaluation.interrupted = evaluation.cases.size() < cases->size();
  return evaluation;
}

}  // namespace ifa
