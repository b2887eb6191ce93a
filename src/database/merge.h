// SPDX-License-Identifier: Apache-2.0
// Joins the shards of a database.
#pragma once

#include <filesystem>
#include <vector>

#include "base/progress.h"
#include "ifa/result.h"

namespace ifa {

/// Writes what one build of everything would have written, byte for byte. The shards, in any order,
/// are checked first (stages "check", "merge"). Needs memory for nothing but the map. Errors:
/// kBadInput when a shard is damaged, of another database, missing or twice there; kInterrupted.
[[nodiscard]] Result<void> mergeDatabases(const std::vector<std::filesystem::path>& shards,
                                          const std::filesystem::path& output,
                                          const Progress& progress);

}  // namespace ifa
