// SPDX-License-Identifier: Apache-2.0
// `ifa verify`: the audit of a motion, exit 0 only when it holds.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "audit/audit.h"
#include "command.h"
#include "pipeline/ensemble_folder.h"
#include "pipeline/motion_folder.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct VerifyOptions {
  fs::path motion;
  std::string object;
};

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

/// One line a body, and how near any two come.
int verifyEnsemble(const VerifyOptions& options, CommandContext& context) {
  const auto folder = readEnsembleFolder(options.motion);
  if (!folder) return context.fail(folder.error());
  std::string bad;
  for (std::size_t i = 0; i < folder->bodies.size(); ++i) {
    const MotionFolder& body = folder->bodies[i];
    const std::string& name = folder->ensemble.bodies[i].name;
    const bool good = body.motion.success && audit(body.motion, body.body).passed();
    context.console.result(fmt::format("{}: {}", name, good ? "the audit holds" : "FAILS"));
    if (!good && bad.empty()) bad = fmt::format("body {} does not hold its audit", name);
  }
  const Separation found = leastSeparation(laidMotions(*folder));
  if (found.known) {
    const auto& bodies = folder->ensemble.bodies;
    context.console.result(fmt::format("nearest: {:.2f} mm, {} and {} at {:.3f} s",
                                       1e3 * found.least, bodies[found.one].name,
                                       bodies[found.other].name, found.time));
    if (found.least <= 0) bad = "bodies meet";
  }
  if (bad.empty()) return context.succeed();
  return context.fail({ErrorCode::kNoMotion, bad, folder->file.string(),
                       "ifa verify of the body's folder tells more"});
}

int runVerify(const VerifyOptions& options, CommandContext& context) {
  if (isEnsemble(options.motion)) return verifyEnsemble(options, context);
  const auto folder = readMotionFolder(options.motion, options.object);
  if (!folder) return context.fail(folder.error());
  for (const std::string& warning : folder->warnings) context.console.warn(warning);
  const AuditReport report = audit(folder->motion, folder->body);
  std::string table = formatAudit(report);
  table.pop_back();  // the console adds its own newline
  context.console.result(table);
  return verdict(folder->motion, report, folder->file.string(), context);
}

}  // namespace

void addVerifyCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App* command = app.add_subcommand("verify", "audit a motion; exit 0 only when it holds");
  command
      ->add_option("MOTION", options->motion,
                   "motion.json or ensemble.json, or the folder that holds it")
      ->required();
  command->add_option("--object", options->object,
                      "name or object file (default: the copy beside the motion)");
  command->callback([options, &context] {
    context.action = [options, &context] { return runVerify(*options, context); };
  });
}

}  // namespace ifa::cli
