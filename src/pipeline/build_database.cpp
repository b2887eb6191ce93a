// SPDX-License-Identifier: Apache-2.0
#include "pipeline/build_database.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/paths.h"
#include "database/database.h"
#include "database/journal.h"
#include "pipeline/learned.h"
#include "sampler/chain_batch.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"
#include "sampler/simulator_comparison.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr double kTimeLimit = 20;      // s per simulation
constexpr std::uint64_t kBlock = 512;  // simulations between two looks at the stop flag
constexpr std::size_t kAhead = 16;     // blocks in memory

/// The header of the file that is asked for, without what only the simulations give.
DatabaseHeader headerOf(const DatabaseRequest& request) {
  DatabaseHeader header;
  header.identity = identityOf(request);
  header.firstSimulation = request.simulations * (request.shard - 1) / request.shards;
  header.simulations =
      request.simulations * request.shard / request.shards - header.firstSimulation;
  return header;
}

/// Simulates blocks of initial states; thread safe.
class BlockSimulator {
 public:
  explicit BlockSimulator(const DatabaseRequest& request)
      : request_(request),
        model_(*request.body, request.surface),
        cut_(recorderFor(request.cut, *request.body, request.surface)) {}

  [[nodiscard]] EventBlock simulate(std::uint64_t first, std::uint64_t count) const {
    EventBlock block;
    block.firstSimulation = first;
    std::vector<RigidState> starts;
    for (std::uint64_t i = 0; i < count; ++i) {
      starts.push_back(sampleInitialState(*request_.body, request_.seed, first + i));
    }
    const bool ode = request_.backend == Backend::kOde;
    for (const auto& records : ode ? simulateOde(starts) : simulateNative(starts)) {
      block.records.insert(block.records.end(), records.begin(), records.end());
      block.counts.push_back(static_cast<std::uint32_t>(records.size()));
    }
    return block;
  }

 private:
  using Records = std::vector<std::vector<EventRecord>>;

  [[nodiscard]] Records simulateNative(const std::vector<RigidState>& starts) const {
    return ChainBatch(model_, cut_).simulate(starts, kTimeLimit);
  }
  [[nodiscard]] Records simulateOde(const std::vector<RigidState>& starts) const {
    Records records(starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const DropResult drop =
          simulateDropOde(*request_.body, request_.surface, starts[i], kTimeLimit, fineOde());
      appendRecords(drop.steps, eventsOf(drop, cut_), records[i]);
    }
    return records;
  }

  const DatabaseRequest& request_;
  BodyModel model_;
  RecorderSettings cut_;
};

/// Simulates what the journal lacks and appends it, in order.
Result<void> fill(Journal& journal, const DatabaseRequest& request, const DatabaseHeader& header,
                  const Progress& progress) {
  const BlockSimulator simulator(request);
  const std::uint64_t done = journal.simulations(), first = header.firstSimulation + done;
  const std::uint64_t left = header.simulations - done;
  std::vector<EventBlock> blocks(kAhead);
  Result<void> result;
  const auto make = [&](std::size_t i) {
    if (progress.stopRequested()) return;
    const std::uint64_t count = std::min(kBlock, left - i * kBlock);
    blocks[i % kAhead] = simulator.simulate(first + i * kBlock, count);
  };
  const auto take = [&](std::size_t i) {
    if (progress.stopRequested()) return false;
    result = journal.append(blocks[i % kAhead]);
    progress("build",
             static_cast<double>(journal.simulations()) / static_cast<double>(header.simulations));
    return result.has_value();
  };
  progress("build", static_cast<double>(done) / static_cast<double>(header.simulations));
  makeInOrder((left + kBlock - 1) / kBlock, kAhead, make, take);
  return result;
}

/// A full disk or a lost one is no reason to begin anew.
Error withResume(Error error) {
  if (error.code != ErrorCode::kBadInput) return error;
  error.remedy += error.remedy.empty() ? "what was simulated is kept: go on with --resume"
                                       : "; what was simulated is kept, go on with --resume";
  return error;
}

Result<Journal> openJournal(const fs::path& output, const DatabaseRequest& request,
                            const DatabaseHeader& header) {
  std::error_code code;
  const fs::path part = journalPath(output);
  if (request.resume) {
    auto journal = Journal::resume(output, header);
    if (!journal) return tl::unexpected(journal.error());
    if (*journal) return std::move(**journal);
  } else if (fs::exists(part, code)) {
    return badInput("an interrupted build is there", part.string(),
                    "go on with --resume, or remove it");
  }
  return Journal::create(output, header);
}

/// The finished file of this very request, where it is there.
std::optional<DatabaseBuild> finished(const fs::path& output, const DatabaseHeader& header) {
  const auto there = EventDatabase::open(output);
  if (!there || !there->checkIdentity(header.identity) ||
      there->header().firstSimulation != header.firstSimulation ||
      there->simulations() != header.simulations) {
    return {};
  }
  return DatabaseBuild{there->simulations(), there->events(), there->simulations(), true};
}

Result<void> checkRequest(const DatabaseRequest& request, const fs::path& output) {
  if (request.shard < 1 || request.shard > request.shards || request.shards > request.simulations) {
    return tl::unexpected<Error>(
        {ErrorCode::kUsage,
         fmt::format("there is no shard {} of {} of {} simulations", request.shard, request.shards,
                     request.simulations),
         "--shard", "I/N with I from 1 to N, and N at most the number of simulations"});
  }
  std::error_code code;
  if (fs::is_directory(output, code)) return badInput("is a folder, not a file", output.string());
  return {};
}

Error interrupted(const Journal& journal, const DatabaseHeader& header, const fs::path& output) {
  return {ErrorCode::kInterrupted,
          fmt::format("interrupted after {} of {} simulations, which are kept",
                      journal.simulations(), header.simulations),
          output.string(), "go on with --resume"};
}

}  // namespace

DatabaseIdentity identityOf(const DatabaseRequest& request) {
  const SurfaceProperties& surface = request.surface;
  const SamplingSettings& sampling = request.body->definition.sampling;
  DatabaseIdentity identity;
  identity.simulationVersion = kSimulationVersion;
  identity.backend = request.backend;
  identity.seed = request.seed;
  identity.allSimulations = request.simulations;
  identity.settings = {surface.restitution,
                       surface.friction,
                       surface.rollingFriction,
                       surface.spinningFriction,
                       surface.referenceImpulse,
                       request.cut == EventCut::kPaper ? 0 : kAudibleShare,
                       request.body->definition.mergeGap,
                       sampling.coneDegrees,
                       sampling.speed,
                       sampling.spin,
                       kTimeLimit,
                       request.backend == Backend::kOde ? fineOde().step : 0};
  identity.bodyHash = hashOf(*request.body);
  identity.settingsHash = hashOf(identity.settings);
  setName(identity.object, request.body->definition.name);
  setName(identity.surface, request.surfaceName);
  return identity;
}

SurfaceProperties withReferenceImpulse(const Body& body, SurfaceProperties surface,
                                       const Progress& progress) {
  if (surface.referenceImpulse <= 0) {
    surface.referenceImpulse = learnObject(body, surface, cacheFolder(), progress).referenceImpulse;
  }
  return surface;
}

fs::path cachedDatabasePath(const DatabaseIdentity& identity) {
  const fs::path cache = cacheFolder();
  if (cache.empty()) return {};
  Hash hash;
  hash.add(identity.bodyHash).add(identity.settingsHash);
  hash.add(std::uint64_t{kDatabaseVersion}).add(std::uint64_t{identity.simulationVersion});
  hash.add(static_cast<std::uint64_t>(identity.backend));
  hash.add(identity.seed).add(identity.allSimulations);
  return cache / fmt::format("database-{:016x}.ifadb", hash.value());
}

Result<DatabaseBuild> buildDatabase(const DatabaseRequest& request, const fs::path& output,
                                    const Progress& progress) {
  if (auto good = checkRequest(request, output); !good) return tl::unexpected(good.error());
  const DatabaseHeader header = headerOf(request);
  const auto stop = [&progress] { return progress.stopRequested(); };
  const auto lock = request.wait ? FileLock::await(output, stop) : FileLock::take(output);
  if (!lock) return tl::unexpected(lock.error());
  std::error_code code;
  if (request.resume && !fs::exists(journalPath(output), code)) {
    if (const auto there = finished(output, header)) return *there;
  }
  auto journal = openJournal(output, request, header);
  if (!journal) return tl::unexpected(journal.error());
  const std::uint64_t before = journal->simulations();
  if (auto filled = fill(*journal, request, header, progress); !filled) {
    return tl::unexpected(withResume(filled.error()));
  }
  if (journal->simulations() < header.simulations) {
    return tl::unexpected(interrupted(*journal, header, output));
  }
  const auto report = [&](double share) { progress("assemble", share); };
  if (auto assembled = journal->assemble(output, report); !assembled) {
    return tl::unexpected(withResume(assembled.error()));
  }
  const DatabaseBuild build{header.simulations, journal->events(), before, false};
  journal->remove();
  return build;
}

}  // namespace ifa
