// SPDX-License-Identifier: Apache-2.0
// The command line: reads the arguments and hands them to one cmd_*.cpp per subcommand.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <exception>
#include <string_view>

#include "base/parallel.h"
#include "base/version.h"
#include "command.h"

namespace ifa::cli {

namespace {

std::atomic<bool> stopRequested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void requestStop(int) { stopRequested.store(true, std::memory_order_relaxed); }

// The first signal asks for a clean end, a second one ends the program at once.
void listenToSignals() {
  struct sigaction action = {};
  action.sa_handler = requestStop;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // A file that may not grow is an error like a full disk, not a reason to die.
  ::signal(SIGXFSZ, SIG_IGN);
}

void addCommands(CLI::App& app, CommandContext& context) {
  addSyncCommand(app, context);
  addDetectCommand(app, context);
  addObjectsCommand(app, context);
  addEnsembleCommand(app, context);
  addSonifyCommand(app, context);
  addRenderCommand(app, context);
  addVerifyCommand(app, context);
  addEvaluateCommand(app, context);
  addDatabaseCommand(app, context);
#ifdef IFA_WITH_STUDIO
  addStudioCommands(app, context);
#endif
}

struct GlobalOptions {
  bool jsonProgress = false;
  int threads = 0;
};

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
  app.set_version_flag("--version", std::string(programVersion()), "print the version and exit");
  app.set_help_all_flag("--help-all", "print the help of every command and exit");
  app.add_flag("--json-progress", options.jsonProgress,
               "write progress, warnings and failure to stderr as JSON lines");
  app.add_option("--threads", options.threads, "number of threads (default: one per core)")
      ->check(CLI::Range(1, 1024));
  app.require_subcommand(1);
  app.fallthrough();
  app.footer("Exit: 0 done, 2 usage, 3 bad input, 4 no acceptable motion, 5 interrupted.");
}

Error usageError(const std::string& message) {
  return {ErrorCode::kUsage, message, {}, "see ifa --help, or ifa COMMAND --help"};
}

// Parsing failed, so what it would have told about --json-progress is not known from it.
bool asksForJsonLines(int argc, char** argv) {
  return std::any_of(argv, argv + argc,
                     [](const char* word) { return std::string_view(word) == "--json-progress"; });
}

int parseAndRun(int argc, char** argv, CommandContext& context) {
  CLI::App app{"Inverse Foley: rigid-body motion synchronised to a contact sound"};
  app.name("ifa");
  GlobalOptions options;
  addGlobalOptions(app, options);
  addCommands(app, context);
  context.console.setJsonLines(asksForJsonLines(argc, argv));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success)) {
      return context.fail(usageError(error.what()));
    }
    return app.exit(error);
  }
  if (options.threads > 0) setThreadCount(options.threads);
  return context.action ? context.action() : 0;
}

int run(int argc, char** argv) {
  CommandContext context;
  context.progress.stop = &stopRequested;
  context.progress.report = [&context](std::string_view stage, double share) {
    context.console.progress(stage, share);
  };
  const auto internalError = [&context](const std::string& what) {
    return context.fail({ErrorCode::kInternal, "internal error: " + what, {}, {}});
  };
  try {
    return parseAndRun(argc, argv, context);
  } catch (const std::exception& error) {
    return internalError(error.what());
  } catch (...) {
    return internalError("of an unknown kind");
  }
}

}  // namespace

int CommandContext::fail(const Error& error) {
  console.failure(error);
  return static_cast<int>(error.code);
}

int CommandContext::succeed(const std::string& output) {
  console.success(output);
  return 0;
}

CLI::Validator numberFrom(double low, double high) {
  const auto complaint = [low, high](const std::string& text) {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return good ? std::string()
                : fmt::format("{} is not a number from {:g} to {:g}", text, low, high);
  };
  return {complaint, fmt::format("FLOAT in [{:g} - {:g}]", low, high), "number"};
}

}  // namespace ifa::cli

int main(int argc, char** argv) {
  ifa::cli::listenToSignals();
  return ifa::cli::run(argc, argv);
}
