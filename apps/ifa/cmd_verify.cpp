// SPDX-License-Identifier: Apache-2.0
// `ifa verify`: the audit of a motion, exit 0 only when it holds.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "audit/audit.h"
#include "body/object_file.h"
#include "command.h"
#include "export/motion_json.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct VerifyOptions {
  fs::path motion;
  std::string object;
};

/// The object that the motion was made with: the copy beside it, else the library's.
Result<Body> loadObjectOf(const Motion& motion, const VerifyOptions& options, Console& console) {
  if (!options.object.empty()) return loadObject(options.object);
  const std::string& name = motion.object.name;
  if (name.empty() || fs::path(name).filename() != name) {
    return badInput("names an object that cannot be looked for", options.motion.string(),
                    "name the object file with --object");
  }
  const fs::path copy = options.motion.parent_path() / (name + ".json");
  std::error_code code;
  if (fs::is_regular_file(copy, code)) return loadObject(copy.string());
  console.warn("no " + name + ".json beside the motion; taking the library's");
  return loadObject(name);
}

int verdict(const Motion& motion, const AuditReport& report, const std::string& place,
            CommandContext& context) {
  const auto failed = std::count_if(report.checks.begin(), report.checks.end(),
                                    [](const AuditCheck& check) { return !check.passed; });
  if (failed > 0) {
    return context.fail({ErrorCode::kNoMotion,
                         fmt::format("{} of {} checks fail", failed, report.checks.size()),
                         place,
                         {}});
  }
  if (!motion.success) {
    return context.fail(
        {ErrorCode::kNoMotion, "holds, but does not meet its sound: " + motion.failure, place, {}});
  }
  context.console.result("the audit holds");
  return context.succeed();
}

int runVerify(VerifyOptions options, CommandContext& context) {
  std::error_code code;
  if (fs::is_directory(options.motion, code)) options.motion /= "motion.json";
  const auto motion = readMotionJson(options.motion);
  if (!motion) return context.fail(motion.error());
  const auto body = loadObjectOf(*motion, options, context.console);
  if (!body) return context.fail(body.error());
  const AuditReport report = audit(*motion, *body);
  std::string table = formatAudit(report);
  table.pop_back();  // the console adds its own newline
  context.console.result(table);
  return verdict(*motion, report, options.motion.string(), context);
}

}  // namespace

void addVerifyCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App* command = app.add_subcommand("verify", "audit a motion; exit 0 only when it holds");
  command->add_option("MOTION", options->motion, "motion.json, or the folder that holds it")
      ->required();
  command->add_option("--object", options->object,
                      "name or object file (default: the copy beside the motion)");
  command->callback([options, &context] {
    context.action = [options, &context] { return runVerify(*options, context); };
  });
}

}  // namespace ifa::cli
