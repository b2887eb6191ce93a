// SPDX-License-Identifier: Apache-2.0
// The stages of `ifa sync`, one call each.
#include "ifa/synchronize.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "audit/audit.h"
#include "base/paths.h"
#include "base/staged_folder.h"
#include "base/stopwatch.h"
#include "base/version.h"
#include "body/symmetry.h"
#include "motion/build_motion.h"
#include "pipeline/check_settings.h"
#include "pipeline/choose_object.h"
#include "pipeline/chosen_body.h"
#include "pipeline/copy_object.h"
#include "pipeline/fit.h"
#include "pipeline/hear.h"
#include "pipeline/learned.h"
#include "pipeline/output.h"
#include "pipeline/settings_hash.h"
#include "pipeline/synchronize_with.h"
#include "pipeline/wishes.h"
#include "planner/planner.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

/// Where no motion is found otherwise, time may be warped besides: share of its energy that a
/// contact may add, and the work that such a motion is worth, where one plan costs 1.
constexpr double kEasedGain = 0.1, kEasedEffort = 5;

// All that the search needs, and what the files are made of afterwards.
struct Job {
  Body body;
  std::string surface;
  Heard heard;
  std::unique_ptr<Planner> planner;
  EnergyOutlook outlook;
  SymmetryGroup symmetry;
  std::vector<PlannedOrientation> orientations;
  std::vector<PlannedPosition> positions;
  std::shared_ptr<const ContactGraph> graph;  // for "graph"
  std::optional<EventDatabase> database;      // for "graph" and "hybrid"
};

Result<Job> prepare(const SynchronizeSettings& settings) {
  if (auto good = checkSettings(settings); !good) return tl::unexpected(good.error());
  auto planner = makePlanner(settings.planner);
  if (!planner) return tl::unexpected(planner.error());
  auto chosen = loadChosenBody(settings);
  if (!chosen) return tl::unexpected(chosen.error());
  auto heard = hear(settings, chosen->body.definition.mergeGap);
  if (!heard) return tl::unexpected(heard.error());
  auto orientations = plannedOrientations(settings.orientations, chosen->body, heard->signature);
  if (!orientations) return tl::unexpected(orientations.error());
  auto positions = plannedPositions(settings.positions, heard->signature);
  if (!positions) return tl::unexpected(positions.error());
  Job job;
  job.positions = std::move(*positions);
  job.orientations = std::move(*orientations);
  job.symmetry = findSymmetry(chosen->body);
  job.body = std::move(chosen->body);
  job.surface = std::move(chosen->surface);
  job.heard = std::move(*heard);
  job.planner = std::move(*planner);
  return job;
}

// Takes time on an object's first use, so it comes after all that can be refused at once.
Result<void> learn(Job& job, const SynchronizeSettings& settings, GraphShelf& shelf,
                   const Progress& progress) {
  for (auto& [name, other] : job.body.definition.surfaces) {
    // A fit learns the rest of the restitutions that it tries; the threshold of hearing stays.
    if (!settings.fit || other.referenceImpulse > 0) continue;
    other.referenceImpulse = learnObject(job.body, other, cacheFolder(), progress).referenceImpulse;
  }
  SurfaceProperties& surface = job.body.definition.surfaces.at(job.surface);
  if (!settings.fit) {
    const Learned learned = learnObject(job.body, surface, cacheFolder(), progress);
    surface.referenceImpulse = learned.referenceImpulse;
    job.outlook = learned.outlook;
  }
  if (settings.planner == "hybrid") {
    auto database = shelf.database(job.body, surface, job.surface, progress);
    if (!database) return tl::unexpected(database.error());
    job.database = std::move(*database);
  }
  if (settings.planner != "graph") return {};
  auto graph = shelf.get(job.body, surface, job.surface, progress);
  if (!graph) return tl::unexpected(graph.error());
  job.graph = std::move(*graph);
  job.database = job.graph->database();
  return {};
}

// The first check that a motion does not pass, told for people; empty when it passes all.
std::string auditFailure(const Motion& motion, const Body& body) {
  const auto report = audit(motion, body);
  const auto failed = std::find_if(report.checks.begin(), report.checks.end(),
                                   [](const AuditCheck& check) { return !check.passed; });
  if (failed == report.checks.end()) return {};
  return fmt::format("the motion found does not hold its audit: {} is {:.3g} {} at {:.3f} s",
                     failed->name, failed->worst, failed->unit, failed->time);
}

// Where the best plan's motion does not hold its audit, the next best plan is asked.
bool holdsAudit(const PlanRequest& request, const Plan& plan) {
  const auto motion = buildMotion(request, plan, 0);
  return motion && auditFailure(*motion, *request.body).empty();
}

PlanRequest makeRequest(const SynchronizeSettings& settings, const Job& job) {
  PlanRequest request;
  request.body = &job.body;
  request.surface = job.body.definition.surfaces.at(job.surface);
  request.surfaceName = job.surface;
  request.symmetry = job.symmetry.elements();
  request.signature = job.heard.signature;
  request.settings.seed = settings.seed;
  request.settings.takes = settings.takes;
  request.settings.timeLimitSeconds = settings.timeLimitSeconds;
  request.settings.energyGain = settings.energyGain;
  request.settings.timeOf = settings.graph.processorTime ? TimeOf::kThread : TimeOf::kClock;
  request.settings.symmetry = settings.graph.symmetry;
  request.settings.earlyExit = settings.graph.earlyExit;
  request.orientations = job.orientations;
  request.positions = job.positions;
  request.outlook = job.outlook;
  request.graph = job.graph.get();
  request.database = job.database ? &*job.database : nullptr;
  request.accepts = holdsAudit;
  return request;
}

// A plan that fails its audit is a bug of ours; it must not pass for a result.
void auditTake(Motion& motion, const Body& body) {
  if (!motion.success) return;
  motion.failure = auditFailure(motion, body);
  motion.success = motion.failure.empty();
}

// On the surface that was asked for, or where the fit goes best.
Result<Fit> planAsAsked(const SynchronizeSettings& settings, const Job& job,
                        const Progress& progress) {
  PlanRequest request = makeRequest(settings, job);
  if (settings.fit) {
    FitRequest wanted{job.planner.get(), request, job.body.definition.surfaces, job.surface,
                      cacheFolder()};
    if (!settings.surface.empty()) {
      wanted.surfaces = {{job.surface, request.surface}};
    }
    return planWithFit(wanted, progress);
  }
  request.settings.warpsAtLast = true;
  auto plans = job.planner->plan(request, progress);
  if (!plans) return tl::unexpected(plans.error());
  return Fit{request, job.surface, request.surface.restitution, std::move(*plans)};
}

// No sound shall be without a motion for the sake of a little energy that nobody sees: where
// nothing that loses energy at every contact is found, contacts may add some.
Result<Fit> plan(const SynchronizeSettings& settings, const Job& job, const Progress& progress) {
  auto found = planAsAsked(settings, job, progress);
  if (!found || found->plans.front().solved || found->plans.front().timeLimitReached ||
      progress.stopRequested() || settings.planner == "graph" || settings.energyGain > 0) {
    return found;
  }
  Fit eased = *found;
  eased.request.settings.energyGain = kEasedGain;
  eased.request.settings.timeWarp = kEasedWarp;
  eased.request.settings.effort = kEasedEffort;
  Progress again;
  again.stop = progress.stop;
  again.report = [&](std::string_view stage, double share) {
    progress(stage == "search" ? "eased search" : stage, share);
  };
  auto plans = job.planner->plan(eased.request, again);
  if (!plans || !plans->front().solved) return found;
  eased.plans = std::move(*plans);
  return eased;
}

struct Search {
  Fit fit;
  double seconds = 0;
  bool interrupted = false;
};

Result<Search> search(const SynchronizeSettings& settings, const Job& job,
                      const Progress& progress) {
  const Stopwatch watch;
  auto planned = plan(settings, job, progress);
  if (!planned) return tl::unexpected(planned.error());
  Search found{std::move(*planned), 0, false};
  found.seconds = watch.seconds();
  found.interrupted = progress.stopRequested();
  if (found.interrupted) {
    // What was finished is kept; a search that was cut off says nothing about what is possible.
    std::erase_if(found.fit.plans, [](const Plan& take) { return !take.solved; });
    if (found.fit.plans.empty()) {
      return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
    }
  }
  return found;
}

DatabaseReference referenceTo(const EventDatabase& database) {
  return {static_cast<std::int64_t>(database.simulations()),
          static_cast<std::int64_t>(database.events()), fmt::format("{:016x}", database.hash())};
}

Result<Motion> makeTake(const SynchronizeSettings& settings, const Job& job, const Search& found,
                        const Plan& plan) {
  auto motion = buildMotion(found.fit.request, plan, settings.preRollSeconds);
  if (!motion) return motion;
  motion->program = programVersion();
  motion->seed = settings.seed;
  motion->planner = settings.planner;
  if (settings.fit) motion->given = GivenSurface{job.surface, found.fit.given};
  motion->object.mesh = copiedMeshName(job.body.definition);
  motion->searchSeconds = found.seconds;
  if (job.database) motion->database = referenceTo(*job.database);
  placeInSound(*motion, job.heard);
  auditTake(*motion, job.body);
  return motion;
}

Result<Synchronization> run(const SynchronizeSettings& settings, Job& job,
                            const Progress& progress) {
  auto found = search(settings, job, progress);
  if (!found) return tl::unexpected(found.error());
  Synchronization result{job.heard.signature, {}, found->interrupted, job.heard.remarks};
  for (const Plan& take : found->fit.plans) {
    auto motion = makeTake(settings, job, *found, take);
    if (!motion) return tl::unexpected(motion.error());
    result.takes.push_back(std::move(*motion));
  }
  std::stable_partition(result.takes.begin(), result.takes.end(),
                        [](const Motion& motion) { return motion.success; });
  // The object that goes with the motion is the one as used.
  job.body.definition.surfaces.at(found->fit.surface) = found->fit.request.surface;
  return result;
}

// The same settings with the one object that explains the sound best, where several are named.
struct Chosen {
  SynchronizeSettings settings;
  ObjectRanking ranking;
};

Result<Chosen> choose(const SynchronizeSettings& settings, const Progress& progress) {
  Chosen chosen{settings, {}};
  const auto objects = candidateObjects(settings.object);
  if (!objects) return tl::unexpected(objects.error());
  if (objects->empty()) return chosen;
  auto ranking = chooseObject(settings, *objects, progress);
  if (!ranking) return tl::unexpected(ranking.error());
  chosen.settings.object = ranking->front().object;
  chosen.ranking = std::move(*ranking);
  return chosen;
}

}  // namespace

Result<Synchronization> synchronizeWith(const SynchronizeSettings& settings, GraphShelf& shelf,
                                        const Progress& progress) {
  auto job = prepare(settings);
  if (!job) return tl::unexpected(job.error());
  if (auto good = learn(*job, settings, shelf, progress); !good) {
    return tl::unexpected(good.error());
  }
  return run(settings, *job, progress);
}

Result<Synchronization> synchronize(const SynchronizeSettings& settings, const Progress& progress) {
  auto chosen = choose(settings, progress);
  if (!chosen) return tl::unexpected(chosen.error());
  GraphShelf shelf(settings.graph, settings.energyGain);
  auto result = synchronizeWith(chosen->settings, shelf, progress);
  if (result) result->ranking = std::move(chosen->ranking);
  return result;
}

Result<Synchronization> synchronizeToFolder(const SynchronizeSettings& wanted,
                                            const fs::path& folder, const OutputSettings& output,
                                            const Progress& progress) {
  auto chosen = choose(wanted, progress);
  if (!chosen) return tl::unexpected(chosen.error());
  const SynchronizeSettings& settings = chosen->settings;
  auto job = prepare(settings);
  if (!job) return tl::unexpected(job.error());
  const std::vector<fs::path> inputs = {settings.sound, settings.labels};
  if (auto good = refuseToOverwrite(folder, inputs, job->body.definition); !good) {
    return tl::unexpected(good.error());
  }
  if (auto good = checkOutput(output); !good) return tl::unexpected(good.error());
  auto staged = StagedFolder::open(folder);
  if (!staged) return tl::unexpected(staged.error());
  GraphShelf shelf(settings.graph, settings.energyGain);
  if (auto good = learn(*job, settings, shelf, progress); !good) {
    return tl::unexpected(good.error());
  }
  auto result = run(settings, *job, progress);
  if (!result) return result;
  for (Motion& take : result->takes) take.settings = hashOf(wanted, output);
  const auto told = writeTakes(staged->path(), result->takes, settings.takes > 1, job->body,
                               job->heard, output, progress);
  if (!told) return tl::unexpected(told.error());
  if (auto good = staged->commit("motion.json", outputNames()); !good) {
    return tl::unexpected(good.error());
  }
  result->warnings.insert(result->warnings.end(), told->begin(), told->end());
  result->ranking = std::move(chosen->ranking);
  // A film that was not finished is missed; what was found is written all the same.
  result->interrupted = result->interrupted || progress.stopRequested();
  return result;
}

}  // namespace ifa
