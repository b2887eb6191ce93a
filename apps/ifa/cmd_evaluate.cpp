// SPDX-License-Identifier: Apache-2.0
// `ifa evaluate`: a set of cases as the paper's Table 1.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "graph_options.h"
#include "orient_option.h"
#include "pipeline/evaluate.h"
#include "pipeline/evaluation_report.h"

namespace ifa::cli {

namespace fs = std::filesystem;

namespace {

struct EvaluateOptions {
  EvaluateSettings settings;
  std::vector<fs::path> inputs;  ///< a folder; or reports
  fs::path report;
  std::string parity;
  std::vector<std::string> orientations;
};

void tellCase(Console& console, const CaseOutcome& outcome) {
  const std::string result =
      outcome.solved ? fmt::format("solved, Score {:.2f}", outcome.score) : outcome.failure;
  console.log(fmt::format("{}/{}: {} contacts, {:.2f} s, {}", outcome.what.object,
                          outcome.what.name, outcome.contacts, outcome.wallSeconds, result));
}

/// The table to stdout, and the report's files.
Result<void> tell(const EvaluateOptions& options, const std::vector<Evaluation>& evaluations,
                  CommandContext& context) {
  std::string table = evaluationTable(evaluations);
  table.pop_back();  // the console adds its own newline
  context.console.result(table);
  if (options.report.empty()) return {};
  return writeEvaluationReport(options.report, evaluations);
}

int runSet(const EvaluateOptions& options, CommandContext& context) {
  const auto evaluation =
      evaluate(options.settings, context.progress,
               [&](const CaseOutcome& outcome) { tellCase(context.console, outcome); });
  if (!evaluation) return context.fail(evaluation.error());
  if (const auto told = tell(options, {*evaluation}, context); !told)
    return context.fail(told.error());
  if (!evaluation->interrupted) return context.succeed(options.report.string());
  return context.fail({ErrorCode::kInterrupted,
                       fmt::format("interrupted after {} cases", evaluation->cases.size()),
                       {},
                       {}});
}

int combineReports(const EvaluateOptions& options, CommandContext& context) {
  std::vector<Evaluation> evaluations;
  for (const fs::path& path : options.inputs) {
    auto read = readEvaluations(path);
    if (!read) return context.fail(read.error());
    evaluations.insert(evaluations.end(), read->begin(), read->end());
  }
  evaluations = mergeByLabel(evaluations);
  for (Evaluation& evaluation : evaluations) {
    if (options.settings.limit > 0) evaluation = firstCases(evaluation, options.settings.limit);
  }
  if (const auto told = tell(options, evaluations, context); !told)
    return context.fail(told.error());
  return context.succeed(options.report.string());
}

int runEvaluate(EvaluateOptions options, CommandContext& context) {
  for (const std::string& text : options.orientations) {
    const auto wish = parseOrientation(text);
    if (!wish) return context.fail(wish.error());
    options.settings.orientations.push_back(*wish);
  }
  std::error_code code;
  const auto isFolder = [&](const fs::path& path) { return fs::is_directory(path, code); };
  const bool several = options.inputs.size() > 1;
  if (several && std::any_of(options.inputs.begin(), options.inputs.end(), isFolder)) {
    return context.fail({ErrorCode::kUsage, "only reports can be several", "DIR",
                         "give one folder of cases, or files that ifa evaluate wrote"});
  }
  if (several || fs::is_regular_file(options.inputs.front(), code)) {
    return combineReports(options, context);
  }
  options.settings.folder = options.inputs.front();
  return runSet(options, context);
}

void addOptions(CLI::App& command, EvaluateOptions& options) {
  EvaluateSettings& settings = options.settings;
  command
      .add_option("DIR", options.inputs,
                  "folders named NAME or NAME@SURFACE; or REPORT.json of earlier runs, to be shown "
                  "as one table, side by side where their labels differ")
      ->required();
  command.add_option("-o,--out", options.report,
                     "report to write: REPORT.json, REPORT.md and charts REPORT-*.svg");
  command.add_option("--label", settings.label,
                     "what the report calls these settings (default: made of them)");
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
  command.add_option("--orient", options.orientations,
                     "as of ifa sync, for every case: last:6=up; repeatable");
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
