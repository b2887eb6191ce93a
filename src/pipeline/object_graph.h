// SPDX-License-Identifier: Apache-2.0
// The contact-event graph of an object, from a database that is named or the cache's.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "base/progress.h"
#include "body/body.h"
#include "graph/contact_graph.h"
#include "ifa/synchronize.h"
#include "pipeline/build_database.h"

namespace ifa {

/// Drops in the database that planner "hybrid" makes of an object on its first use. Fixed, so that
/// a plan does not depend on what happens to be cached.
inline constexpr std::uint64_t kHybridSimulations = 20000;

/// Keeps the last graph that was asked for, so that one search after another need not index the
/// same database. The options and the energy gain are those of all. Thread safe.
class GraphShelf {
 public:
  GraphShelf(GraphOptions options, double energyGain)
      : options_(std::move(options)), energyGain_(energyGain) {}

  /// @param surface  with its J_ref
  /// Errors: kBadInput for a database of another body, surface, version or cut, kInterrupted; those
  /// of buildDatabase.
  [[nodiscard]] Result<std::shared_ptr<const ContactGraph>> get(const Body& body,
                                                                const SurfaceProperties& surface,
                                                                const std::string& surfaceName,
                                                                const Progress& progress);

  /// The database alone, for planner "hybrid": the one that is named, or the cache's of
  /// kHybridSimulations drops. Where that cannot be kept, or cannot be read, it is made anew.
  [[nodiscard]] Result<EventDatabase> database(const Body& body, const SurfaceProperties& surface,
                                               const std::string& surfaceName,
                                               const Progress& progress) const;

 private:
  [[nodiscard]] std::filesystem::path pathOf(const DatabaseRequest& request) const;
  [[nodiscard]] Result<EventDatabase> openAt(const DatabaseRequest& request,
                                             const std::optional<EventCut>& cut,
                                             const std::filesystem::path& path,
                                             const Progress& progress) const;
  [[nodiscard]] GraphSettings graphSettings() const;

  GraphOptions options_;
  double energyGain_;
  std::mutex mutex_;
  std::filesystem::path path_;
  std::shared_ptr<const ContactGraph> graph_;
};

}  // namespace ifa
