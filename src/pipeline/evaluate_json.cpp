// SPDX-License-Identifier: Apache-2.0
// The report of evaluations in JSON, and its files.
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/version.h"
#include "export/json_node.h"
#include "pipeline/evaluation_report.h"
#include "sampler/paper_rows.h"

namespace ifa {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "inverse-foley-evaluation";
constexpr std::size_t kLargestReport = 256 << 20;

struct Factor {
  const char* name;
  double ContactFactors::*value;
};
constexpr Factor kFactors[] = {{"v", &ContactFactors::v}, {"q", &ContactFactors::q},
                               {"t", &ContactFactors::t}, {"a", &ContactFactors::a},
                               {"l", &ContactFactors::l}, {"c", &ContactFactors::c},
                               {"o", &ContactFactors::o}, {"p", &ContactFactors::p}};

Json paperJson(const PaperRow* paper) {
  if (paper == nullptr) return nullptr;
  return {{"nodes", paper->nodes},   {"mean_n", paper->meanContacts},
          {"solved", paper->solved}, {"sounds", paper->sounds},
          {"score", paper->score},   {"search_minutes", paper->searchMinutes}};
}

Json rowJson(const EvaluationRow& row) {
  return {
      {"name", row.name},
      {"paper", paperJson(paperRowNamed(row.name))},
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

Json factorsJson(const std::vector<ContactFactors>& contacts) {
  Json factors = Json::object();
  for (const Factor& factor : kFactors) {
    Json values = Json::array();
    for (const ContactFactors& contact : contacts) values.push_back(contact.*factor.value);
    factors[factor.name] = std::move(values);
  }
  return factors;
}

Json continuousJson(const std::vector<ContinuousContact>& contacts) {
  Json list = Json::array();
  for (const ContinuousContact& contact : contacts) {
    list.push_back({{"target_duration", contact.targetDuration},
                    {"duration", contact.duration},
                    {"target_centroid", contact.targetCentroid},
                    {"centroid", contact.centroid}});
  }
  return list;
}

Json placesJson(const std::optional<PlaceErrors>& places) {
  if (!places) return nullptr;
  return {
      {"mean", places->mean}, {"largest", places->largest}, {"longest_side", places->longestSide}};
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
          {"factors", factorsJson(outcome.factors)},
          {"continuous", continuousJson(outcome.continuous)},
          {"places", placesJson(outcome.places)},
          {"orientation_errors", outcome.orientationErrors},
          {"database_events", outcome.events < 0 ? Json(nullptr) : Json(outcome.events)},
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

Json reportJson(const Evaluation& evaluation) {
  Json rows = Json::array(), cases = Json::array();
  for (const EvaluationRow& row : evaluation.rows) rows.push_back(rowJson(row));
  for (const CaseOutcome& outcome : evaluation.cases) cases.push_back(caseJson(outcome));
  return {{"format", kFormat},
          {"version", 1},
          {"program", std::string(programVersion())},
          {"label", settingsLabel(evaluation.settings)},
          {"planner", evaluation.settings.planner},
          {"simulations", evaluation.settings.graph.simulations},
          {"seed", evaluation.settings.seed},
          {"restitution_scale", evaluation.settings.restitutionScale},
          {"fit", evaluation.settings.fit},
          {"parity", parityName(evaluation.settings.parity)},
          {"interrupted", evaluation.interrupted},
          {"objects", std::move(rows)},
          {"total", rowJson(evaluation.total)},
          {"cases", std::move(cases)}};
}

// ---- Reading ----

std::vector<double> numbersOf(const JsonNode& node) {
  std::vector<double> values;
  for (std::size_t i = 0; i < node.count(); ++i) values.push_back(node.item(i).number());
  return values;
}

std::vector<ContactFactors> readFactors(const JsonNode& node) {
  std::vector<ContactFactors> contacts(node.member("v").count());
  for (const Factor& factor : kFactors) {
    const JsonNode values = node.member(factor.name);
    const std::size_t count = values.count(contacts.size());
    for (std::size_t i = 0; i < count; ++i) contacts[i].*factor.value = values.item(i).number();
  }
  return contacts;
}

std::vector<ContinuousContact> readContinuous(const JsonNode& node) {
  std::vector<ContinuousContact> contacts;
  for (std::size_t i = 0; i < node.count(); ++i) {
    const JsonNode one = node.item(i);
    contacts.push_back({one.member("target_duration").number(), one.member("duration").number(),
                        one.member("target_centroid").number(), one.member("centroid").number()});
  }
  return contacts;
}

CaseOutcome readCase(const JsonNode& node) {
  CaseOutcome outcome;
  outcome.done = true;
  outcome.what.object = node.member("object").text();
  outcome.what.surface = node.member("surface").text();
  outcome.what.name = node.member("name").text();
  outcome.contacts = node.member("n").integer<int>();
  outcome.solved = node.member("solved").flag();
  if (node.has("failure")) outcome.failure = node.member("failure").text();
  outcome.score = node.member("score").number();
  outcome.scoreWithoutSound = node.member("score_without_sound").number();
  outcome.meanFv = node.member("mean_f_v").number();
  outcome.bends = numbersOf(node.member("bends"));
  outcome.arrivalBends = numbersOf(node.member("arrival_bends"));
  outcome.factors = readFactors(node.member("factors"));
  outcome.continuous = readContinuous(node.member("continuous"));
  if (node.has("places")) {
    const JsonNode places = node.member("places");
    outcome.places = PlaceErrors{places.member("mean").number(), places.member("largest").number(),
                                 places.member("longest_side").number()};
  }
  outcome.orientationErrors = numbersOf(node.member("orientation_errors"));
  if (node.has("database_events"))
    outcome.events = node.member("database_events").integer<std::int64_t>();
  if (node.has("seconds_to_good")) outcome.goodSeconds = node.member("seconds_to_good").number();
  outcome.givenRestitution = node.member("given_restitution").number();
  outcome.restitution = node.member("restitution").number();
  outcome.startError = node.member("largest_start_error").number();
  outcome.searchSeconds = node.member("search_seconds").number();
  outcome.wallSeconds = node.member("wall_seconds").number();
  return outcome;
}

Evaluation readReport(const JsonNode& node) {
  EvaluateSettings settings;
  if (node.member("format").text() != kFormat) node.member("format").reject("is another format");
  if (node.member("version").integer<int>() != 1)
    node.member("version").reject("is not known to this program");
  settings.label = node.member("label").text();
  settings.planner = node.member("planner").text();
  settings.graph.simulations = node.member("simulations").integer<std::uint64_t>();
  settings.seed = node.member("seed").integer<std::uint64_t>();
  settings.restitutionScale = node.member("restitution_scale").number();
  settings.fit = node.member("fit").flag();
  const std::string parity = node.member("parity").text();
  if (parity != "all") settings.parity = parity == "even" ? Parity::kEven : Parity::kOdd;
  std::vector<CaseOutcome> cases;
  const JsonNode list = node.member("cases");
  for (std::size_t i = 0; i < list.count(); ++i) cases.push_back(readCase(list.item(i)));
  Evaluation evaluation = sumUp(std::move(settings), std::move(cases));
  evaluation.interrupted = node.member("interrupted").flag();
  return evaluation;
}

}  // namespace

std::string evaluationJson(const std::vector<Evaluation>& evaluations) {
  Json reports = Json::array();
  for (const Evaluation& evaluation : evaluations) reports.push_back(reportJson(evaluation));
  const Json all = reports.size() == 1 ? std::move(reports[0]) : Json{{"reports", reports}};
  return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::vector<Evaluation>> readEvaluations(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kLargestReport);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto json = nlohmann::json::parse(*bytes, nullptr, false);
  if (json.is_discarded()) return badInput("is no JSON", path.string());
  std::string problem;
  const JsonNode root(&json, "", &problem);
  std::vector<Evaluation> evaluations;
  if (root.has("reports")) {
    const JsonNode reports = root.member("reports");
    for (std::size_t i = 0; i < reports.count(); ++i)
      evaluations.push_back(readReport(reports.item(i)));
  } else {
    evaluations.push_back(readReport(root));
  }
  if (problem.empty()) return evaluations;
  return badInput(problem, path.string(), "give a REPORT.json that ifa evaluate wrote");
}

Result<void> writeEvaluationReport(std::filesystem::path report,
                                   const std::vector<Evaluation>& evaluations) {
  const std::string extension = report.extension().string();
  if (extension == ".json" || extension == ".md") report.replace_extension();
  const std::string stem = report.filename().string();
  for (const EvaluationChart& chart : evaluationCharts(evaluations)) {
    auto written = writeFileAtomically(report.string() + "-" + chart.name + ".svg", chart.svg);
    if (!written) return written;
  }
  auto written =
      writeFileAtomically(report.string() + ".md", evaluationMarkdown(evaluations, stem));
  if (!written) return written;
  return writeFileAtomically(report.string() + ".json", evaluationJson(evaluations));
}

}  // namespace ifa
