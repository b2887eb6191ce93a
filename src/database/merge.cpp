// SPDX-License-Identifier: Apache-2.0
#include "database/merge.h"

#include <fmt/format.h>

#include <algorithm>

#include "database/database.h"
#include "database/writer.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

/// So much is copied between two looks at the stop flag: bytes, simulations.
constexpr std::size_t kPiece = std::size_t{1} << 20;

tl::unexpected<Error> interrupted() {
  return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
}

/// All shards, checked, in order of their simulations.
Result<std::vector<EventDatabase>> openAll(const std::vector<fs::path>& paths,
                                           const Progress& progress) {
  std::vector<EventDatabase> shards;
  for (const fs::path& path : paths) {
    auto shard = EventDatabase::open(path);
    if (!shard) return tl::unexpected(shard.error());
    if (!shards.empty()) {
      const std::string difference =
          differenceOf(shard->header().identity, shards[0].header().identity);
      if (!difference.empty()) {
        return badInput("is not of one database with the first: " + difference, path.string(),
                        "merge what one call of ifa database build made, but for --shard");
      }
    }
    shards.push_back(std::move(*shard));
  }
  for (std::size_t i = 0; i < shards.size(); ++i) {
    const double before = static_cast<double>(i), all = static_cast<double>(shards.size());
    Progress part = progress;
    part.report = [&](std::string_view stage, double share) {
      progress(stage, (before + share) / all);
    };
    if (auto good = shards[i].check(part); !good) return tl::unexpected(good.error());
  }
  std::sort(shards.begin(), shards.end(), [](const EventDatabase& a, const EventDatabase& b) {
    return a.header().firstSimulation < b.header().firstSimulation;
  });
  return shards;
}

/// Whether the shards, in order, are all simulations and each once.
Result<void> checkComplete(const std::vector<EventDatabase>& shards) {
  std::uint64_t next = 0;
  const std::uint64_t all = shards[0].header().identity.allSimulations;
  const auto missing = [&](std::uint64_t end) {
    return badInput(fmt::format("simulations {} to {} of {} are missing", next, end - 1, all), {},
                    "name every shard of the database");
  };
  for (const EventDatabase& shard : shards) {
    const std::uint64_t first = shard.header().firstSimulation;
    if (first > next) return missing(first);
    if (first < next) {
      return badInput(fmt::format("simulation {} is in another shard, too", first),
                      shard.path().string(), "name every shard once");
    }
    next = first + shard.simulations();
  }
  return next < all ? Result<void>(missing(all)) : Result<void>();
}

Result<void> copyColumn(const EventDatabase& shard, std::size_t column, DatabaseWriter& writer,
                        const Progress& progress) {
  for (auto rest = shard.bytes(column); !rest.empty();) {
    const auto piece = rest.first(std::min(kPiece, rest.size()));
    if (auto put = writer.append(column, piece); !put) return put;
    rest = rest.subspan(piece.size());
    if (progress.stopRequested()) return interrupted();
  }
  return {};
}

Result<void> copyCounts(const EventDatabase& shard, DatabaseWriter& writer) {
  std::vector<std::uint32_t> counts;
  for (std::size_t k = 0; k < shard.simulations(); ++k) {
    counts.push_back(static_cast<std::uint32_t>(shard.firstEvent(k + 1) - shard.firstEvent(k)));
    if (counts.size() < kPiece && k + 1 < shard.simulations()) continue;
    if (auto put = writer.appendCounts(counts); !put) return put;
    counts.clear();
  }
  return {};
}

}  // namespace

Result<void> mergeDatabases(const std::vector<fs::path>& paths, const fs::path& output,
                            const Progress& progress) {
  const auto lock = FileLock::take(output);
  if (!lock) return tl::unexpected(lock.error());
  const auto shards = openAll(paths, progress);
  if (!shards) return tl::unexpected(shards.error());
  if (auto complete = checkComplete(*shards); !complete) return complete;
  DatabaseHeader header;
  header.identity = (*shards)[0].header().identity;
  header.simulations = header.identity.allSimulations;
  for (const EventDatabase& shard : *shards) header.events += shard.events();
  auto writer = DatabaseWriter::create(output, header);
  if (!writer) return tl::unexpected(writer.error());
  for (std::size_t column = 0; column < kFirstEvents; ++column) {
    for (const EventDatabase& shard : *shards) {
      if (auto copied = copyColumn(shard, column, *writer, progress); !copied) return copied;
    }
    progress("merge", static_cast<double>(column + 1) / kColumns);
  }
  for (const EventDatabase& shard : *shards) {
    if (auto copied = copyCounts(shard, *writer); !copied) return copied;
  }
  auto finished = writer->finish();
  if (finished) progress("merge", 1);
  return finished;
}

}  // namespace ifa
