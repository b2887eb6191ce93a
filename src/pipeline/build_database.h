// SPDX-License-Identifier: Apache-2.0
// Samples simulations of an object into an event database. docs/database.md.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/progress.h"
#include "body/body.h"
#include "database/format.h"

namespace ifa {

struct DatabaseRequest {
  const Body* body = nullptr;
  SurfaceProperties surface;
  std::string surfaceName;
  std::uint64_t simulations = 0;  ///< of the whole database, > 0
  std::uint64_t seed = 1;
  Backend backend = Backend::kNative;
  EventCut cut = EventCut::kAudible;
  std::uint64_t shard = 1, shards = 1;  ///< this build makes number `shard` (from 1) of `shards`
  bool resume = false;  ///< go on with what an interrupted build left, if it left anything
  bool wait = false;    ///< until another process that makes the same file is done
};

struct DatabaseBuild {
  std::uint64_t simulations = 0, events = 0;  ///< in the file
  std::uint64_t simulatedBefore = 0;          ///< taken from an interrupted build
  bool wasThere = false;  ///< with `resume`: the finished file was there already
};

/// What the database will be of. `surface.referenceImpulse` must be set (see withReferenceImpulse).
[[nodiscard]] DatabaseIdentity identityOf(const DatabaseRequest& request);

/// The surface with its J_ref, which is learnt (learnObject) where the object file has none.
[[nodiscard]] SurfaceProperties withReferenceImpulse(const Body& body, SurfaceProperties surface,
                                                     const Progress& progress);

/// Where planners look for the database of an object, a surface, a seed and a size, and where
/// `ifa database build` puts it when no file is named: cacheFolder(). Empty when there is none.
[[nodiscard]] std::filesystem::path cachedDatabasePath(const DatabaseIdentity& identity);

/// Simulates and writes `output`. Until that is whole it does not exist (or is the older one);
/// what is done meanwhile is in `output`.part. The same bytes whatever the number of threads and of
/// interruptions. Reports as "build", then "assemble". Errors: kUsage for an impossible shard,
/// kInterrupted, and kBadInput where the file cannot be written, is being made by another process,
/// or where an interrupted build is in the way or of something else.
[[nodiscard]] Result<DatabaseBuild> buildDatabase(const DatabaseRequest& request,
                                                  const std::filesystem::path& output,
                                                  const Progress& progress);

}  // namespace ifa
