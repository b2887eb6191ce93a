// SPDX-License-Identifier: Apache-2.0
// What every subcommand is given, and the function by which each cmd_*.cpp adds itself.
//
// A subcommand looks like this:
//
//   void addDetectCommand(CLI::App& app, CommandContext& context) {
//     auto options = std::make_shared<DetectOptions>();
//     CLI::App* command = app.add_subcommand("detect", "find the contacts of a sound");
//     command->add_option("sound", options->sound, "sound file")->required();
//     command->callback([options, &context] {
//       context.action = [options, &context] { return runDetect(*options, context); };
//     });
//   }
//
// `runDetect` returns the exit code: 0, or what `context.fail(error)` returned.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/progress.h"
#include "console.h"
#include "ifa/result.h"

namespace ifa::cli {

/// Shared by all subcommands; lives in main for the whole run.
struct CommandContext {
  Console console;              ///< the only way to stdout and stderr
  std::function<int()> action;  ///< set by the chosen subcommand's callback, run after parsing
  Progress progress;            ///< reports to `console`; stops on SIGINT and SIGTERM

  /// Tells the error on stderr. Returns its exit code.
  [[nodiscard]] int fail(const Error& error);
  /// Tells the end of the work to whoever reads JSON lines. Returns 0.
  [[nodiscard]] int succeed(const std::string& output = {});
};

/// Accepts numbers from `low` to `high`. CLI::Range lets "nan" through.
[[nodiscard]] CLI::Validator numberFrom(double low, double high);

void addSyncCommand(CLI::App& app, CommandContext& context);
void addDetectCommand(CLI::App& app, CommandContext& context);
void addObjectsCommand(CLI::App& app, CommandContext& context);
void addEnsembleCommand(CLI::App& app, CommandContext& context);
void addSonifyCommand(CLI::App& app, CommandContext& context);
void addRenderCommand(CLI::App& app, CommandContext& context);
void addVerifyCommand(CLI::App& app, CommandContext& context);
void addEvaluateCommand(CLI::App& app, CommandContext& context);
void addDatabaseCommand(CLI::App& app, CommandContext& context);
/// Only in a build with the studio (IFA_WITH_STUDIO).
void addStudioCommands(CLI::App& app, CommandContext& context);

}  // namespace ifa::cli
