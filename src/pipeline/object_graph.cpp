// SPDX-License-Identifier: Apache-2.0
#include "pipeline/object_graph.h"

#include <cstdlib>
#include <system_error>

namespace ifa {

namespace fs = std::filesystem;

namespace {

DatabaseRequest requestOf(const Body& body, const SurfaceProperties& surface,
                          const std::string& surfaceName, const GraphOptions& options) {
  DatabaseRequest request;
  request.body = &body;
  request.surface = surface;
  request.surfaceName = surfaceName;
  request.simulations = options.simulations;
  request.cut = options.cut.value_or(EventCut::kAudible);
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
/// same; seed and size need not, nor the cut of its events where none is asked for.
Result<EventDatabase> openFor(DatabaseRequest request, const std::optional<EventCut>& cut,
                              const fs::path& path) {
  auto database = EventDatabase::open(path);
  if (!database) return database;
  if (auto same = database->checkBody(*request.body); !same) return tl::unexpected(same.error());
  const DatabaseIdentity& there = database->header().identity;
  request.cut = cut.value_or(cutOf(there.settings));
  DatabaseIdentity wanted = identityOf(request);
  wanted.seed = there.seed;
  wanted.allSimulations = there.allSimulations;
  if (auto same = database->checkIdentity(wanted); !same) return tl::unexpected(same.error());
  return database;
}

/// The same where there is no cache that could keep it: made, opened, and gone when it is closed.
Result<EventDatabase> openUnkept(const DatabaseRequest& request, const Progress& progress) {
  std::error_code code;
  std::string folder = (fs::temp_directory_path(code) / "inverse-foley-XXXXXX").string();
  if (code || mkdtemp(folder.data()) == nullptr) {
    return badInput("there is neither a cache folder nor a temporary one for its database",
                    request.body->definition.name, "set XDG_CACHE_HOME or TMPDIR");
  }
  const fs::path file = fs::path(folder) / "events.ifadb";
  const auto built = buildDatabase(request, file, progress);
  auto database =
      built ? openFor(request, request.cut, file) : tl::unexpected<Error>(built.error());
  fs::remove_all(folder, code);
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

fs::path GraphShelf::pathOf(const DatabaseRequest& request) const {
  return options_.database.empty() ? cachedDatabasePath(identityOf(request)) : options_.database;
}

Result<EventDatabase> GraphShelf::openAt(const DatabaseRequest& request,
                                         const std::optional<EventCut>& cut, const fs::path& path,
                                         const Progress& progress) const {
  if (options_.database.empty()) {
    if (auto there = ensureCached(request, path, progress); !there) {
      return tl::unexpected(there.error());
    }
  }
  return openFor(request, cut, path);
}

Result<std::shared_ptr<const ContactGraph>> GraphShelf::get(const Body& body,
                                                            const SurfaceProperties& surface,
                                                            const std::string& surfaceName,
                                                            const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const DatabaseRequest request = requestOf(body, surface, surfaceName, options_);
  const fs::path path = pathOf(request);
  if (graph_ && path == path_) return graph_;
  graph_.reset();
  auto database = openAt(request, options_.cut, path, progress);
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
  DatabaseRequest request = requestOf(body, surface, surfaceName, options_);
  request.simulations = kHybridSimulations;
  request.cut = EventCut::kAudible;
  auto database = openAt(request, request.cut, pathOf(request), progress);
  if (database || !options_.database.empty() || progress.stopRequested()) return database;
  return openUnkept(request, progress);
}

}  // namespace ifa
