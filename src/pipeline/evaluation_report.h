// SPDX-License-Identifier: Apache-2.0
// Reports of evaluations: JSON, Markdown and charts, of one or of several side by side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ifa/result.h"
#include "pipeline/evaluate.h"

namespace ifa {

/// What reports call these settings: "graph, 400000 drops, 60 s".
[[nodiscard]] std::string settingsLabel(const EvaluateSettings& settings);

/// The rows in Markdown as the paper's Table 1, of each evaluation and of the paper one below the
/// other.
[[nodiscard]] std::string evaluationTable(const std::vector<Evaluation>& evaluations);

/// The whole report in Markdown: the table; what lasts, places and orientations where there are
/// any; charts; and under "## Cases" each case.
/// @param stem  file name that charts begin with
[[nodiscard]] std::string evaluationMarkdown(const std::vector<Evaluation>& evaluations,
                                             const std::string& stem);

/// The report in JSON, of several as {"reports": [...]}.
[[nodiscard]] std::string evaluationJson(const std::vector<Evaluation>& evaluations);

/// Reads the JSON of one or several: their labels and cases, and what the tables need of the
/// settings. Errors: kBadInput with the field.
[[nodiscard]] Result<std::vector<Evaluation>> readEvaluations(const std::filesystem::path& path);

/// Those of the same label as one, in order of first appearance; a case that is in several is
/// taken from the last.
[[nodiscard]] std::vector<Evaluation> mergeByLabel(const std::vector<Evaluation>& evaluations);

/// Only the first `limit` cases of each row.
[[nodiscard]] Evaluation firstCases(const Evaluation& evaluation, std::size_t limit);

/// A chart of a report.
struct EvaluationChart {
  std::string name;   ///< "score": of the file STEM-score.svg
  std::string title;  ///< for those who do not see it
  std::string svg;
};

/// Those that there are data for; of more evaluations than can be told apart only what compares
/// them.
[[nodiscard]] std::vector<EvaluationChart> evaluationCharts(
    const std::vector<Evaluation>& evaluations);

/// Writes REPORT.json, REPORT.md and REPORT-*.svg.
/// @param report  with one of these endings, or none
[[nodiscard]] Result<void> writeEvaluationReport(std::filesystem::path report,
                                                 const std::vector<Evaluation>& evaluations);

}  // namespace ifa
