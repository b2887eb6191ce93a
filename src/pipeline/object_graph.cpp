// SPDX-License-Identifier: Apache-2.0
#include "pipeline/object_graph.h"

#include <system_error>

#include "pipeline/build_database.h"

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
  settings.symmetry = options_.symmetry;
  return settings;
}

Result<std::shared_ptr<const ContactGraph>> GraphShelf::get(const Body& body,
                                                            const SurfaceProperties& surface,
                                                            const std::string& surfaceName,
                                                            const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const DatabaseRequest request = requestOf(body, surface, surfaceName, options_.simulations);
  const bool named = !options_.database.empty();
  const fs::path path = named ? options_.database : cachedDatabasePath(identityOf(request));
  if (graph_ && path == path_) return graph_;
  if (!named) {
    if (auto there = ensureCached(request, path, progress); !there) {
      return tl::unexpected(there.error());
    }
  }
  graph_.reset();
  auto database = openFor(request, path);
  if (!database) return tl::unexpected(database.error());
  auto graph = ContactGraph::make(std::move(*database), body, graphSettings(), progress);
  if (!graph) return tl::unexpected(graph.error());
  path_ = path;
  graph_ = std::make_shared<const ContactGraph>(std::move(*graph));
  return graph_;
}

}  // namespace ifa
