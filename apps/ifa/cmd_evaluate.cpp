// SPDX-License-Identifier: Apache-2.0
// `ifa evaluate`: a set of cases as the paper's Table 1.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "base/file.h"
#include "command.h"
#include "graph_options.h"
#include "pipeline/evaluate.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct EvaluateOptions {
  EvaluateSettings settings;
  fs::path report;
  std::string parity;
};

void tellCase(Console& console, const CaseOutcome& outcome) {
  const std::string result =
      outcome.solved ? fmt::format("solved, Score {:.2f}", outcome.score) : outcome.failure;
  console.log(fmt::format("{}/{}: {} contacts, {:.2f} s, {}", outcome.what.object,
                          outcome.what.name, outcome.contacts, outcome.wallSeconds, result));
}

/// REPORT.json and REPORT.md, whichever ending was given.
Result<void> writeReport(fs::path report, const Evaluation& evaluation) {
  const std::string extension = report.extension().string();
  if (extension == ".json" || extension == ".md") report.replace_extension();
  const fs::path json = report.string() + ".json", markdown = report.string() + ".md";
  if (auto written = writeFileAtomically(json, evaluationJson(evaluation)); !written)
    return written;
  return writeFileAtomically(markdown, evaluationMarkdown(evaluation, true));
}

int runEvaluate(const EvaluateOptions& options, CommandContext& context) {
  const auto evaluation =
      evaluate(options.settings, context.progress,
               [&](const CaseOutcome& outcome) { tellCase(context.console, outcome); });
  if (!evaluation) return context.fail(evaluation.error());
  std::string table = evaluationMarkdown(*evaluation, false);
  table.pop_back();  // the console adds its own newline
  context.console.result(table);
  if (!options.report.empty()) {
    if (const auto written = writeReport(options.report, *evaluation); !written) {
      return context.fail(written.error());
    }
  }
  if (!evaluation->interrupted) return context.succeed(options.report.string());
  return context.fail({ErrorCode::kInterrupted,
                       fmt::format("interrupted after {} cases", evaluation->cases.size()),
                       {},
                       {}});
}

void addOptions(CLI::App& command, EvaluateOptions& options) {
  EvaluateSettings& settings = options.settings;
  command.add_option("DIR", settings.folder, "folders named NAME or NAME@SURFACE")->required();
  command.add_option("-o,--out", options.report, "report to write: REPORT.json and REPORT.md");
  command.add_option("--planner", settings.planner, "hybrid, shoot or graph")
      ->capture_default_str();
  command.add_option("--seed", settings.seed, "of the searches")->capture_default_str();
  command.add_option("--time-limit", settings.timeLimitSeconds, "seconds per case (0: none)")
      ->check(numberFrom(0, 1e6));
  command
      .add_option("--restitution-scale", settings.restitutionScale,
                  "plan with so many times the objects' restitution, at most 0.95")
      ->check(CLI::Range(0.1, 10.0))
      ->capture_default_str();
  command.add_flag("--fit", settings.fit, "look for the restitution that suits each sound");
  command.add_option("--jobs", settings.jobs, "cases at a time; wall times suffer")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_option("--limit", settings.limit, "only so many cases of each object (0: all)");
  command.add_option("--parity", options.parity, "only cases whose name ends in such a number")
      ->check(CLI::IsMember({"even", "odd"}));
  addGraphOptions(command, settings.graph);
}

}  // namespace

void addEvaluateCommand(CLI::App& app, CommandContext& context) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App* command = app.add_subcommand("evaluate", "run a set of cases and tabulate");
  addOptions(*command, *options);
  command->callback([options, &context] {
    if (options->parity == "even") options->settings.parity = Parity::kEven;
    if (options->parity == "odd") options->settings.parity = Parity::kOdd;
    context.action = [options, &context] { return runEvaluate(*options, context); };
  });
}

}  // namespace ifa::cli
