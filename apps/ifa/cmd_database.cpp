// SPDX-License-Identifier: Apache-2.0
// `ifa database`: build, merge and look at event databases.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "body/object_file.h"
#include "command.h"
#include "database/database.h"
#include "database/merge.h"
#include "database_text.h"
#include "pipeline/build_database.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct BuildOptions {
  std::string object, surface, shard, backend = "native", cut = "audible";
  fs::path output;
  DatabaseRequest request;
};

struct MergeOptions {
  std::vector<fs::path> shards;
  fs::path output;
};

struct InfoOptions {
  fs::path file;
  std::string object;
  bool check = false;
};

template <class Number>
bool readNumber(std::string_view text, Number& number) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  return code == std::errc() && end == text.data() + text.size();
}

/// Reads "I/N"; CLI::Validator's way to say what is wrong.
std::string readShard(const std::string& text, DatabaseRequest& request) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view all = text;
  const bool good = slash < all.size() && readNumber(all.substr(0, slash), request.shard) &&
                    readNumber(all.substr(slash + 1), request.shards) && request.shard >= 1 &&
                    request.shard <= request.shards && request.shards <= 100000;
  return good ? std::string() : text + " is not I/N with I from 1 to N";
}

Result<SurfaceProperties> findSurface(const Body& body, std::string& name) {
  const ObjectDefinition& definition = body.definition;
  if (name.empty()) name = definition.defaultSurface;
  const auto found = definition.surfaces.find(name);
  if (found != definition.surfaces.end()) return found->second;
  std::string names;
  for (const auto& entry : definition.surfaces) names += (names.empty() ? "" : ", ") + entry.first;
  return badInput(fmt::format("{} knows no surface {}", definition.name, name), "--surface",
                  "one of " + names);
}

/// Where the file goes: as named, else the cache.
Result<fs::path> outputOf(const BuildOptions& options, const DatabaseRequest& request) {
  if (!options.output.empty()) return options.output;
  if (request.shards > 1) {
    return tl::unexpected<Error>(
        {ErrorCode::kUsage, "a shard needs a file of its own", "--shard", "name it with -o"});
  }
  const fs::path path = cachedDatabasePath(identityOf(request));
  if (path.empty()) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "there is no cache folder", "-o",
                                  "name a file with -o, or set XDG_CACHE_HOME"});
  }
  std::error_code code;
  fs::create_directories(path.parent_path(), code);
  return path;
}

std::string builtText(const DatabaseBuild& build, const fs::path& output, double seconds) {
  const std::string counts =
      fmt::format("{} simulations, {} events", build.simulations, build.events);
  if (build.wasThere) return fmt::format("{} are in {} already", counts, output.string());
  const std::uint64_t now = build.simulations - build.simulatedBefore;
  std::string text = fmt::format("{} written to {}", counts, output.string());
  if (build.simulatedBefore > 0) text += fmt::format(" ({} from before)", build.simulatedBefore);
  return text + fmt::format(", {:.0f} simulations/s", static_cast<double>(now) / seconds);
}

int runBuild(const BuildOptions& options, CommandContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const auto body = loadObject(options.object);
  if (!body) return context.fail(body.error());
  DatabaseRequest request = options.request;
  request.body = &*body;
  request.backend = options.backend == "ode" ? Backend::kOde : Backend::kNative;
  request.cut = cutNamed(options.cut);
  request.surfaceName = options.surface;
  const auto surface = findSurface(*body, request.surfaceName);
  if (!surface) return context.fail(surface.error());
  request.surface = withReferenceImpulse(*body, *surface, context.progress);
  const auto output = outputOf(options, request);
  if (!output) return context.fail(output.error());
  // In the cache nobody wants an error because it is there, or was begun.
  request.resume = request.resume || options.output.empty();
  const auto build = buildDatabase(request, *output, context.progress);
  if (!build) return context.fail(build.error());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  context.console.result(builtText(*build, *output, took.count()));
  return context.succeed(output->string());
}

int runMerge(const MergeOptions& options, CommandContext& context) {
  if (const auto merged = mergeDatabases(options.shards, options.output, context.progress);
      !merged) {
    return context.fail(merged.error());
  }
  const auto database = EventDatabase::open(options.output);
  if (!database) return context.fail(database.error());
  context.console.result(fmt::format("{} simulations, {} events written to {}",
                                     database->simulations(), database->events(),
                                     options.output.string()));
  return context.succeed(options.output.string());
}

int runInfo(const InfoOptions& options, CommandContext& context) {
  const auto database = EventDatabase::open(options.file);
  if (!database) return context.fail(database.error());
  if (!options.object.empty()) {
    const auto body = loadObject(options.object);
    if (!body) return context.fail(body.error());
    if (const auto same = database->checkBody(*body); !same) return context.fail(same.error());
  }
  if (options.check) {
    if (const auto good = database->check(context.progress); !good) {
      return context.fail(good.error());
    }
  }
  context.console.result(databaseText(*database, options.check));
  return context.succeed();
}

void addBuild(CLI::App& database, CommandContext& context) {
  auto options = std::make_shared<BuildOptions>();
  CLI::App* command = database.add_subcommand("build", "simulate an object many times");
  command->add_option("OBJECT", options->object, "name or object file")->required();
  command->add_option("-n,--simulations", options->request.simulations, "how many")
      ->required()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000}));
  command->add_option("-o,--out", options->output, "file to write (default: the cache)");
  command->add_option("--surface", options->surface, "of the object file (default: its own)");
  command->add_option("--seed", options->request.seed, "of the initial states")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--shard", options->shard, "make part I of N only; ifa database merge joins")
      ->check(CLI::Validator(
          [](const std::string& text) {
            DatabaseRequest ignored;
            return readShard(text, ignored);
          },
          "I/N", "shard"));
  command->add_flag("--resume", options->request.resume, "go on with an interrupted build");
  command->add_option("--backend", options->backend, "native, or ode for comparison")
      ->check(CLI::IsMember({"native", "ode"}))
      ->capture_default_str();
  command->add_option("--cut", options->cut, "events: audible, or paper (any impulse above zero)")
      ->check(CLI::IsMember({"audible", "paper"}))
      ->capture_default_str();
  command->callback([options, &context] {
    if (!options->shard.empty()) (void)readShard(options->shard, options->request);
    context.action = [options, &context] { return runBuild(*options, context); };
  });
}

void addMerge(CLI::App& database, CommandContext& context) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = database.add_subcommand("merge", "join the shards of a database");
  command->add_option("SHARDS", options->shards, "all of them, in any order")->required();
  command->add_option("-o,--out", options->output, "file to write")->required();
  command->callback([options, &context] {
    context.action = [options, &context] { return runMerge(*options, context); };
  });
}

void addInfo(CLI::App& database, CommandContext& context) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = database.add_subcommand("info", "what is in a database");
  command->add_option("FILE", options->file, "database")->required();
  command->add_flag("--check", options->check, "read all of it and compare the checksums");
  command->add_option("--object", options->object, "fail unless it was made of this object");
  command->callback([options, &context] {
    context.action = [options, &context] { return runInfo(*options, context); };
  });
}

}  // namespace

void addDatabaseCommand(CLI::App& app, CommandContext& context) {
  CLI::App* command = app.add_subcommand("database", "build, merge and check event databases");
  command->require_subcommand(1);
  addBuild(*command, context);
  addMerge(*command, context);
  addInfo(*command, context);
}

}  // namespace ifa::cli
