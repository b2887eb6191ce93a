// SPDX-License-Identifier: Apache-2.0
// The report of an evaluation: sums, Markdown, JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "pipeline/evaluate.h"

namespace ifa {
namespace {

using Json = nlohmann::ordered_json;

/// The smallest value that is not under `share` of all; 0 of none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// A bar would end the cell, a line end the row.
std::string cell(std::string text) {
  for (char& c : text) {
    if (c == '|') c = '/';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

/// What only searches of a database have.
std::string markdownOfGraph(const EvaluationRow& row) {
  return fmt::format(" {}/{} | {} | {:.3f} | {:.2f} | {:.2f} |", row.good, row.cases,
                     row.good > 0 ? fmt::format("{:.2f}", row.meanGoodSeconds) : "",
                     row.meanScoreWithoutSound, row.arrivalBendMedian, row.arrivalBendMax);
}

std::string markdownRow(const EvaluationRow& row) {
  const double share = row.cases > 0 ? 100.0 * row.solved / row.cases : 0;
  return fmt::format(
      "| {} | {} | {} | {:.1f} | {}/{} ({:.0f} %) | {:.2f} | {:.3f} | {:.3f} | {:.2f} | {:.1f} % "
      "| {:.2f} | {:.2f} | {:.2f} |{}\n",
      row.name, row.events < 0 ? "none" : std::to_string(row.events), row.cases, row.meanContacts,
      row.solved, row.cases, share, row.meanSearchSeconds, row.meanScore, row.meanFv,
      row.bendMedian, 100 * row.bendShareUpToOne, row.bendMax, row.wallMedian, row.wallP95,
      row.events < 0 ? "" : markdownOfGraph(row));
}

/// "0.56", or "0.80 for 0.56" where it was fitted.
std::string restitutionOf(const CaseOutcome& outcome) {
  const std::string used = fmt::format("{:.2f}", outcome.restitution);
  if (outcome.restitution == outcome.givenRestitution) return used;
  return fmt::format("{} for {:.2f}", used, outcome.givenRestitution);
}

std::string markdownCase(const CaseOutcome& outcome) {
  const double largest =
      outcome.bends.empty() ? 0 : *std::max_element(outcome.bends.begin(), outcome.bends.end());
  return fmt::format(
      "| {} | {} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} | {} |\n",
      outcome.what.object, outcome.what.name, outcome.contacts, outcome.solved ? "yes" : "no",
      outcome.score, outcome.meanFv, median(outcome.bends), largest, outcome.searchSeconds,
      outcome.wallSeconds, restitutionOf(outcome), cell(outcome.failure));
}

Json rowJson(const EvaluationRow& row) {
  return {
      {"name", row.name},
      {"database_events", row.events < 0 ? Json(nullptr) : Json(row.events)},
      {"cases", row.cases},
      {"mean_n", row.meanContacts},
      {"solved", row.solved},
      {"mean_search_seconds", row.meanSearchSeconds},
      {"mean_score", row.meanScore},
      {"mean_score_without_sound", row.meanScoreWithoutSound},
      {"arrival_bend", {{"median", row.arrivalBendMedian}, {"max", row.arrivalBendMax}}},
      {"good", row.good},
      {"mean_seconds_to_good", row.meanGoodSeconds},
      {"mean_f_v", row.meanFv},
      {"bend",
       {{"median", row.bendMedian}, {"share_up_to_1", row.bendShareUpToOne}, {"max", row.bendMax}}},
      {"wall_seconds", {{"median", row.wallMedian}, {"p95", row.wallP95}}}};
}

Json caseJson(const CaseOutcome& outcome) {
  return {{"object", outcome.what.object},
          {"surface", outcome.what.surface},
          {"name", outcome.what.name},
          {"n", outcome.contacts},
          {"solved", outcome.solved},
          {"failure", outcome.failure.empty() ? Json(nullptr) : Json(outcome.failure)},
          {"score", outcome.score},
          {"score_without_sound", outcome.scoreWithoutSound},
          {"mean_f_v", outcome.meanFv},
          {"bends", outcome.bends},
          {"arrival_bends", outcome.arrivalBends},
          {"seconds_to_good", outcome.goodSeconds < 0 ? Json(nullptr) : Json(outcome.goodSeconds)},
          {"given_restitution", outcome.givenRestitution},
          {"restitution", outcome.restitution},
          {"largest_start_error", outcome.startError},
          {"search_seconds", outcome.searchSeconds},
          {"wall_seconds", outcome.wallSeconds}};
}

std::string parityName(const std::optional<Parity>& parity) {
  return !parity ? "all" : *parity == Parity::kEven ? "even" : "odd";
}

}  // namespace

EvaluationRow summarize(std::string name, const std::vector<CaseOutcome>& cases) {
  EvaluationRow row;
  row.name = std::move(name);
  std::vector<double> bends, arrivals, walls;
  double contacts = 0, heard = 0, solvedContacts = 0, logFv = 0;
  for (const CaseOutcome& outcome : cases) {
    ++row.cases;
    contacts += outcome.contacts;
    if (outcome.contacts > 0) ++heard;  // else it broke before its contacts were known
    walls.push_back(outcome.wallSeconds);
    row.events = std::max(row.events, outcome.events);
    if (!outcome.solved) continue;
    ++row.solved;
    if (outcome.goodSeconds >= 0) {
      ++row.good;
      row.meanGoodSeconds += outcome.goodSeconds;
    }
    row.meanScoreWithoutSound += outcome.scoreWithoutSound;
    arrivals.insert(arrivals.end(), outcome.arrivalBends.begin(), outcome.arrivalBends.end());
    row.meanSearchSeconds += outcome.searchSeconds;
    row.meanScore += outcome.score;
    logFv += outcome.contacts * std::log(std::max(1e-300, outcome.meanFv));
    solvedContacts += outcome.contacts;
    bends.insert(bends.end(), outcome.bends.begin(), outcome.bends.end());
  }
  if (heard > 0) row.meanContacts = contacts / heard;
  row.wallMedian = median(walls);
  row.wallP95 = quantile(walls, 0.95);
  if (row.solved == 0) return row;
  row.meanSearchSeconds /= row.solved;
  row.meanScore /= row.solved;
  row.meanScoreWithoutSound /= row.solved;
  if (row.good > 0) row.meanGoodSeconds /= row.good;
  row.arrivalBendMedian = median(arrivals);
  row.arrivalBendMax = quantile(arrivals, 1);
  row.meanFv = std::exp(logFv / std::max(1.0, solvedContacts));
  row.bendMedian = median(bends);
  row.bendMax = quantile(bends, 1);
  const auto good = std::count_if(bends.begin(), bends.end(), [](double b) { return b <= 1; });
  row.bendShareUpToOne =
      static_cast<double>(good) / static_cast<double>(std::max<std::size_t>(1, bends.size()));
  return row;
}

std::string evaluationMarkdown(const Evaluation& evaluation, bool withCases) {
  const bool graph = evaluation.total.events >= 0;
  std::string text =
      "| object | events in database | cases | mean n | solved | search, s | Score | f_v | bend, "
      "median | bend at most 1 | bend, largest | wall, median s | wall, p95 s |";
  if (graph) {
    text += " Score 0.3 | s to 0.3 | Score without sound | arrival bend, median | largest |";
  }
  text += "\n|---|---|---|---|---|---|---|---|---|---|---|---|---|";
  text += graph ? "---|---|---|---|---|\n" : "\n";
  for (const EvaluationRow& row : evaluation.rows) text += markdownRow(row);
  text += markdownRow(evaluation.total);
  if (evaluation.interrupted) text += "\nInterrupted: only the cases that were done.\n";
  if (!withCases) return text;
  text +=
      "\n| object | case | n | solved | Score | f_v | bend, median | bend, largest | search, s | "
      "wall, s | restitution | why not |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const CaseOutcome& outcome : evaluation.cases) text += markdownCase(outcome);
  return text;
}

std::string evaluationJson(const Evaluation& evaluation) {
  Json rows = Json::array(), cases = Json::array();
  for (const EvaluationRow& row : evaluation.rows) rows.push_back(rowJson(row));
  for (const CaseOutcome& outcome : evaluation.cases) cases.push_back(caseJson(outcome));
  const Json report = {{"format", "inverse-foley-evaluation"},
                       {"version", 1},
                       {"program", std::string(programVersion())},
                       {"planner", evaluation.settings.planner},
                       {"seed", evaluation.settings.seed},
                       {"restitution_scale", evaluation.settings.restitutionScale},
                       {"fit", evaluation.settings.fit},
                       {"parity", parityName(evaluation.settings.parity)},
                       {"interrupted", evaluation.interrupted},
                       {"objects", rows},
                       {"total", rowJson(evaluation.total)},
                       {"cases", cases}};
  return report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ifa
