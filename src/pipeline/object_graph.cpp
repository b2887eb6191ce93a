// SPDX-License-Identifier: Apache-2.0
#include "pipeline/object_graph.h"

#include <system_error>

namespace ifa {

namespace fs = std::filesystem;

namespace {

DatabaseRequest requestOf(const Body& body, const SurfaceProperties& surface,
                          const std::string& surfaceName, std::uint64_t simulations) {
  DatabaseRequest request;
  request.body = &body;
  request.surface = surface;
  request.surfaceName = surfaceName;
  request.simulations = simulations;
  request.resume = request.wait = true;
  return request;
}

/// Makes the cache's database at `path` where it is not.
Result<void> ensureCached(const DatabaseRequest& request, const fs::path& path,
                          const Progress& progress) {
  if (path.empty()) {
    return badInput("there is no cache folder for its database", request.body->definition.name,
                    "name a database, or set XDG_CACHE_HOME");
  }
  std::error_code code;
  fs::create_directories(path.parent_path(), code);
  if (auto built = buildDatabase(request, path, progress); !built) {
    return tl::unexpected(built.error());
  }
  return {};
}

/// What is planned from a database is simulated again, so body, surface and simulation must be the
/// same; seed and size need not.
Result<EventDatabase> openFor(const DatabaseRequest& request, const fs::path& path) {
  auto database = EventDatabase::open(path);
  if (!database) return database;
  if (auto same = database->checkBody(*request.body); !same) return tl::unexpected(same.error());
  DatabaseIdentity wanted = identityOf(request);
  const DatabaseIdentity& there = database->header().identity;
  wanted.seed = there.seed;
  wanted.allSimulations = there.allSimulations;
  if (auto same = database->checkIdentity(wanted); !same) return tl::unexpected(same.error());
  return database;
}

}  // namespace

GraphSettings GraphShelf::graphSettings() const {
  GraphSettings settings;
  if (options_.printedVelocity) settings.velocityReference = VelocityReference::kPrinted;
  if (options_.timeWarp) settings.connection = ConnectionKind::kBlend;
  settings.energyGain = energyGain_;
  return settings;
}

fs::path GraphShelf::pathOf(const DatabaseRequest& request) const {
  return options_.database.empty() ? cachedDatabasePath(identityOf(request)) : options_.database;
}

Result<EventDatabase> GraphShelf::openAt(const DatabaseRequest& request, const fs::path& path,
                                         const Progress& progress) const {
  if (options_.database.empty()) {
    if (auto there = ensureCached(request, path, progress); !there) {
      return tl::unexpected(there.error());
    }
  }
  return openFor(request, path);
}

Result<std::shared_ptr<const ContactGraph>> GraphShelf::get(const Body& body,
                                                            const SurfaceProperties& surface,
                                                            const std::string& surfaceName,
                                                            const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const DatabaseRequest request = requestOf(body, surface, surfaceName, options_.simulations);
  const fs::path path = pathOf(request);
  if (graph_ && path == path_) return graph_;
  graph_.reset();
  auto database = openAt(request, path, progress);
  if (!database) return tl::unexpected(database.error());
  auto graph = ContactGraph::make(std::move(*database), body, graphSettings(), progress);
  if (!graph) return tl::unexpected(graph.error());
  path_ = path;
  graph_ = std::make_shared<const ContactGraph>(std::move(*graph));
  return graph_;
}

Result<EventDatabase> GraphShelf::database(const Body& body, const SurfaceProperties& surface,
                                           const std::string& surfaceName,
                                           const Progress& progress) const {
  const DatabaseRequest request = requestOf(body, surface, surfaceName, kHybridSimulations);
  return openAt(request, pathOf(request), progress);
}

}  // namespace ifa
