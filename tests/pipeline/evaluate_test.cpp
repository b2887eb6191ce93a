// SPDX-License-Identifier: Apache-2.0
#include "pipeline/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "body/object_file.h"
#include "dynamics/simulator.h"
#include "pipeline/evaluation_report.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"
#include "signature/signature_json.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// An evaluation set made of empty files.
class EvaluationSet : public testing::Test {
 protected:
  EvaluationSet() : root_(testing::TempDir() + "ifa_evaluate_" + std::to_string(::getpid())) {
    fs::create_directories(root_);
    settings_.folder = root_;
  }
  ~EvaluationSet() override { fs::remove_all(root_); }

  void add(const std::string& path, const std::string& content = {}) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << content;
  }
  std::vector<std::string> found() {
    std::vector<std::string> names;
    const auto cases = findCases(settings_);
    for (const EvaluationCase& what : cases.value()) {
      names.push_back(what.object + (what.surface.empty() ? "" : "@" + what.surface) + "/" +
                      what.name);
    }
    return names;
  }

  fs::path root_;
  EvaluateSettings settings_;
};

TEST_F(EvaluationSet, IsFoundInNaturalOrder) {
  add("d10/a_2.signature.json");
  add("d10/a_10.signature.json");
  add("d6@felt/x.wav");
  add("d6@felt/x.txt");
  add("d6@felt/without_labels.wav");
  add("d6/y.flac");
  add("d6/y.txt");
  add("d6/y.json");
  add("README.md");
  EXPECT_THAT(found(), testing::ElementsAre("d6/y", "d6@felt/x", "d10/a_2", "d10/a_10"));
}

TEST_F(EvaluationSet, CanBeHalvedAndCut) {
  for (int i = 0; i < 13; ++i) add("d6/c" + std::to_string(i) + ".signature.json");
  add("d6/unnumbered.signature.json");
  settings_.parity = Parity::kOdd;
  EXPECT_THAT(found(), testing::ElementsAre("d6/c1", "d6/c3", "d6/c5", "d6/c7", "d6/c9", "d6/c11"));
  settings_.parity = Parity::kEven;
  settings_.limit = 2;
  EXPECT_THAT(found(), testing::ElementsAre("d6/c0", "d6/c2"));
}

TEST_F(EvaluationSet, MustHoldACase) {
  EXPECT_EQ(findCases(settings_).error().code, ErrorCode::kBadInput);
  settings_.folder = root_ / "nothing";
  EXPECT_EQ(findCases(settings_).error().code, ErrorCode::kBadInput);
}

TEST_F(EvaluationSet, GoesOnAfterAFailure) {
  add("NoSuchObject/a.signature.json", "{}");
  add("d6/broken.signature.json", "{}");
  std::vector<std::string> told;
  settings_.jobs = 2;
  const auto evaluation = evaluate(
      settings_, {}, [&](const CaseOutcome& outcome) { told.push_back(outcome.what.name); });
  ASSERT_TRUE(evaluation.has_value()) << evaluation.error().text();
  EXPECT_EQ(told.size(), 2u);
  EXPECT_EQ(evaluation->total.cases, 2);
  EXPECT_EQ(evaluation->total.solved, 0);
  ASSERT_EQ(evaluation->rows.size(), 2u);
  for (const CaseOutcome& outcome : evaluation->cases) EXPECT_FALSE(outcome.failure.empty());
}

struct HeardDrop {
  ContactSignature signature;
  nlohmann::json places = nlohmann::json::array();
};

/// What a listener would write down of a drop of `object`, and where it was.
HeardDrop hearADrop(const std::string& object) {
  const Body body = loadObject(object).value();
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  const auto drop = simulateDrop(body, surface, sampleInitialState(body, 3, 1), 20);
  const auto events = eventsOf(drop, audibleCut(body, surface));
  HeardDrop heard;
  for (const ContactEvent& event : events) {
    const double duration = event.filteredDuration(body.definition.mergeGap);
    heard.signature.events.push_back({event.start - events.front().start, duration,
                                      event.amplitude / events.front().amplitude,
                                      duration > 0 ? event.centroid : 0, 1});
    heard.places.push_back({event.before.position.x(), event.before.position.y()});
  }
  return heard;
}

TEST_F(EvaluationSet, SolvesWhatADropGave) {
  const ContactSignature signature = hearADrop("Eraser").signature;
  add("Eraser/drop.signature.json", formatSignature(signature));
  const auto evaluation = evaluate(settings_, {});
  ASSERT_TRUE(evaluation.has_value());
  const CaseOutcome& outcome = evaluation->cases.at(0);
  EXPECT_TRUE(outcome.solved) << outcome.failure;
  EXPECT_EQ(outcome.contacts, static_cast<int>(signature.events.size()));
  EXPECT_EQ(outcome.bends.size(), signature.events.size());
  EXPECT_GE(outcome.score, 0.5);
  EXPECT_GT(outcome.wallSeconds, 0);
  EXPECT_EQ(outcome.factors.size(), signature.events.size());
  EXPECT_FALSE(outcome.places.has_value());
}

TEST_F(EvaluationSet, TellsHowFarPlacesAndOrientationsAreOff) {
  const HeardDrop heard = hearADrop("Eraser");
  add("Eraser/drop.signature.json", formatSignature(heard.signature));
  add("Eraser/drop.json", nlohmann::json{{"positions", heard.places}}.dump());
  OrientationWish wish;
  wish.world = -wish.world;
  settings_.orientations = {wish};
  const auto evaluation = evaluate(settings_, {});
  ASSERT_TRUE(evaluation.has_value());
  const CaseOutcome& outcome = evaluation->cases.at(0);
  ASSERT_TRUE(outcome.solved) << outcome.failure;
  ASSERT_TRUE(outcome.places.has_value());
  EXPECT_LE(outcome.places->mean, outcome.places->largest);
  EXPECT_LT(outcome.places->largest, 0.3 * outcome.places->longestSide);
  ASSERT_EQ(outcome.orientationErrors.size(), 1u);
  EXPECT_LT(outcome.orientationErrors[0], 0.07);
  const std::string markdown = evaluationMarkdown({*evaluation}, "report");
  EXPECT_THAT(markdown, HasSubstr("| drop | hybrid, last:0,0,1=down |"));
  EXPECT_THAT(markdown, HasSubstr("| Garlic 1 | paper |"));
  EXPECT_THAT(markdown, HasSubstr("| Eraser | hybrid, last:0,0,1=down | 1/1 (100 %) | 1/1 |"));
}

TEST_F(EvaluationSet, NamesWhatIsWrongWithPlaces) {
  const std::string signature = formatSignature(hearADrop("Eraser").signature);
  for (const char* name : {"a", "b", "c"}) {
    add(std::string("Eraser/") + name + ".signature.json", signature);
  }
  add("Eraser/a.json", "{");
  add("Eraser/b.json", R"({"positions": [[0, 0, 0]]})");
  add("Eraser/c.json", R"({"positions": [[0, 0]], "labelled": [[0, 0], [1, 0]]})");
  const auto evaluation = evaluate(settings_, {});
  ASSERT_TRUE(evaluation.has_value());
  ASSERT_EQ(evaluation->cases.size(), 3u);
  EXPECT_THAT(evaluation->cases[0].failure, HasSubstr("is no JSON"));
  EXPECT_THAT(evaluation->cases[1].failure, HasSubstr("positions[0]"));
  EXPECT_THAT(evaluation->cases[2].failure, HasSubstr("'labelled' has not as many"));
}

TEST_F(EvaluationSet, CanBePlannedWithAWrongRestitutionAndFitted) {
  add("Eraser/drop.signature.json", formatSignature(hearADrop("Eraser").signature));
  settings_.restitutionScale = 0.7;
  const auto wrong = evaluate(settings_, {});
  ASSERT_TRUE(wrong.has_value());
  EXPECT_NEAR(wrong->cases.at(0).restitution, 0.7 * 0.338, 1e-9);
  EXPECT_EQ(wrong->cases.at(0).givenRestitution, wrong->cases.at(0).restitution);
  settings_.fit = true;
  const auto fitted = evaluate(settings_, {});
  ASSERT_TRUE(fitted.has_value());
  EXPECT_NEAR(fitted->cases.at(0).givenRestitution, 0.7 * 0.338, 1e-9);
  EXPECT_TRUE(fitted->cases.at(0).solved);
  const auto json = nlohmann::json::parse(evaluationJson({*fitted}));
  EXPECT_EQ(json["fit"], true);
  EXPECT_EQ(json["restitution_scale"], 0.7);
  EXPECT_EQ(json["cases"][0]["restitution"], fitted->cases.at(0).restitution);
}

TEST_F(EvaluationSet, StopsWhenAsked) {
  add("d6/a.signature.json", "{}");
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const auto evaluation = evaluate(settings_, progress);
  ASSERT_TRUE(evaluation.has_value());
  EXPECT_TRUE(evaluation->interrupted);
  EXPECT_TRUE(evaluation->cases.empty());
}

CaseOutcome solvedCase(int contacts, double score, double fv, double seconds) {
  CaseOutcome outcome;
  outcome.what = {"d6", "", "case", {}, {}, {}};
  outcome.solved = outcome.done = true;
  outcome.contacts = contacts;
  outcome.score = score;
  outcome.meanFv = fv;
  outcome.searchSeconds = outcome.wallSeconds = seconds;
  outcome.bends.assign(static_cast<std::size_t>(contacts), 0.5);
  return outcome;
}

TEST(EvaluationRow, SumsUp) {
  std::vector<CaseOutcome> cases = {solvedCase(3, 0.8, 0.5, 1), solvedCase(1, 0.6, 1, 3)};
  cases[0].bends = {0, 0.2, 1.4};
  CaseOutcome failed = solvedCase(8, 0.1, 0.1, 9);
  failed.solved = false;
  cases.push_back(failed);
  const EvaluationRow row = summarize("d6", cases);
  EXPECT_EQ(row.cases, 3);
  EXPECT_EQ(row.solved, 2);
  EXPECT_DOUBLE_EQ(row.meanContacts, 4);
  EXPECT_DOUBLE_EQ(row.meanSearchSeconds, 2);
  EXPECT_DOUBLE_EQ(row.meanScore, 0.7);
  EXPECT_NEAR(row.meanFv, std::pow(0.5, 0.75), 1e-12);  // three contacts of four at 0.5
  EXPECT_DOUBLE_EQ(row.bendMedian, 0.35);
  EXPECT_DOUBLE_EQ(row.bendShareUpToOne, 0.75);
  EXPECT_DOUBLE_EQ(row.bendMax, 1.4);
  EXPECT_DOUBLE_EQ(row.wallMedian, 3);
  EXPECT_DOUBLE_EQ(row.wallP95, 9);
}

TEST(EvaluationRow, SumsUpWhatSearchesOfADatabaseTell) {
  std::vector<CaseOutcome> cases = {solvedCase(2, 0.5, 0.5, 1), solvedCase(2, 0.2, 0.5, 1)};
  for (CaseOutcome& outcome : cases) {
    outcome.events = 700;
    outcome.arrivalBends = {0, 3};
    outcome.scoreWithoutSound = 0.4;
  }
  cases[0].goodSeconds = 0.25;
  cases[1].arrivalBends = {0, 5};
  EvaluateSettings settings;
  settings.planner = "graph";
  const Evaluation evaluation = sumUp(settings, cases);
  const EvaluationRow& row = evaluation.total;
  EXPECT_EQ(row.events, 700);
  EXPECT_EQ(row.good, 1);
  EXPECT_DOUBLE_EQ(row.meanGoodSeconds, 0.25);
  EXPECT_DOUBLE_EQ(row.meanScoreWithoutSound, 0.4);
  EXPECT_DOUBLE_EQ(row.arrivalBendMedian, 1.5);
  EXPECT_DOUBLE_EQ(row.arrivalBendMax, 5);
  EXPECT_THAT(evaluationTable({evaluation}), HasSubstr("| all | graph, 40000 drops | 700 |"));
  EXPECT_THAT(evaluationTable({evaluation}), HasSubstr("| 1/2 | 0.25 | 1.50 | 5.00 |"));
}

/// One of each thing that a report tells.
Evaluation evaluationOfAll() {
  std::vector<CaseOutcome> cases = {solvedCase(3, 0.8, 0.5, 1)};
  cases[0].failure = "a | b\nc";
  cases[0].givenRestitution = 0.5;
  cases[0].restitution = 0.625;
  cases[0].factors.assign(3, {0.5, 0.75, 1, 0.25, 1, 0.125, 1, 1});
  cases[0].arrivalBends = {0, 0.25, 0.5};
  cases[0].continuous = {{0.1, 0.125, 0.05, 0.058}};
  cases[0].places = PlaceErrors{0.01, 0.02, 0.5};
  cases[0].orientationErrors = {0.03125};
  return sumUp({}, cases);
}

TEST(EvaluationReport, TellsTheSameInMarkdownAndJson) {
  const Evaluation evaluation = evaluationOfAll();
  const std::string markdown = evaluationMarkdown({evaluation}, "report");
  EXPECT_THAT(markdown, HasSubstr("| d6 | hybrid | none | 1 | 3.0 | 1/1 (100 %) | 1.00 | 0.800 |"));
  EXPECT_THAT(markdown,
              HasSubstr("|  | paper | 6751058 | 14 | 20.4 | 13/14 (93 %) | 726 | 0.41 |"));
  EXPECT_THAT(markdown, HasSubstr("| all | hybrid | 1 | 8.0 | 8.0 | 100 % | 25.0 | 25.0 |"));
  EXPECT_THAT(markdown, HasSubstr("| 2.0 / 0.040 | 1.0 / 0.020 | 50.0 |"));
  EXPECT_THAT(markdown, HasSubstr("| 0.62 for 0.50 | a / b c |"));
  EXPECT_THAT(markdown, HasSubstr("](report-bend.svg)"));
  EXPECT_THAT(evaluationTable({evaluation}), testing::Not(HasSubstr("| case |")));
  const auto json = nlohmann::json::parse(evaluationJson({evaluation}));
  EXPECT_EQ(json["format"], "inverse-foley-evaluation");
  EXPECT_EQ(json["objects"][0]["mean_score"], 0.8);
  EXPECT_EQ(json["objects"][0]["paper"]["sounds"], 14);
  EXPECT_EQ(json["cases"][0]["bends"].size(), 3u);
  EXPECT_EQ(json["cases"][0]["factors"]["c"][2], 0.125);
  EXPECT_EQ(json["parity"], "all");
}

TEST_F(EvaluationSet, ReportsAreReadAgain) {
  Evaluation other = evaluationOfAll();
  other.settings.planner = "graph";
  other.cases[0].events = 900;
  other = sumUp(other.settings, other.cases);
  const std::vector<Evaluation> both = {evaluationOfAll(), other};
  const auto written = writeEvaluationReport(root_ / "report.md", both);
  ASSERT_TRUE(written.has_value()) << written.error().text();
  for (const char* name : {"report-bend.svg", "report-factors-2.svg", "report-time.svg"}) {
    EXPECT_TRUE(fs::exists(root_ / name)) << name;
  }
  const auto read = readEvaluations(root_ / "report.json");
  ASSERT_TRUE(read.has_value()) << read.error().text();
  EXPECT_EQ(evaluationJson(*read), evaluationJson(both));
  EXPECT_EQ(evaluationMarkdown(*read, "report"), evaluationMarkdown(both, "report"));
}

TEST_F(EvaluationSet, OnlyReportsAreReadAsReports) {
  add("a.json", "{}");
  EXPECT_THAT(readEvaluations(root_ / "a.json").error().text(), HasSubstr("'format' is missing"));
  add("a.json", "[");
  EXPECT_THAT(readEvaluations(root_ / "a.json").error().text(), HasSubstr("is no JSON"));
  auto json = nlohmann::json::parse(evaluationJson({evaluationOfAll()}));
  json["cases"][0]["factors"]["q"] = {1};
  add("a.json", json.dump());
  EXPECT_THAT(readEvaluations(root_ / "a.json").error().text(), HasSubstr("cases[0].factors.q"));
}

TEST(EvaluationReport, MergesWhatHasOneLabel) {
  CaseOutcome d6 = solvedCase(3, 0.8, 0.5, 1), d4 = solvedCase(2, 0.6, 0.5, 1);
  d4.what.object = "d4";
  CaseOutcome again = solvedCase(3, 0.9, 0.5, 1);
  EvaluateSettings shoot;
  shoot.planner = "shoot";
  const auto merged = mergeByLabel({sumUp({}, {d6}), sumUp(shoot, {d6}), sumUp({}, {d4, again})});
  ASSERT_EQ(merged.size(), 2u);
  ASSERT_EQ(merged[0].rows.size(), 2u);
  EXPECT_EQ(merged[0].rows[0].name, "d4");  // the paper's order
  EXPECT_DOUBLE_EQ(merged[0].rows[1].meanScore, 0.9);
  EXPECT_EQ(merged[1].total.cases, 1);
  again.what.name = "another";
  const Evaluation first = firstCases(sumUp({}, {d6, again, d4}), 1);
  ASSERT_EQ(first.cases.size(), 2u);
  EXPECT_EQ(first.cases[1].what.name, "case");
  const std::string table = evaluationTable(merged);
  EXPECT_THAT(table, HasSubstr("| d4 | hybrid |"));
  EXPECT_THAT(table, HasSubstr("|  | shoot |"));
  EXPECT_THAT(table, HasSubstr("|  | paper |  | 24 |  | 19/24 (79 %) |"));
}

TEST(EvaluationReport, DrawsScoreAgainstTheSizeOfTheDatabase) {
  EvaluateSettings small, large;
  small.planner = large.planner = "graph";
  small.graph.simulations = 1000;
  large.graph.simulations = 8000;
  const auto charts = evaluationCharts(
      {sumUp(large, {solvedCase(3, 0.8, 0.5, 1)}), sumUp(small, {solvedCase(3, 0.4, 0.5, 1)})});
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_EQ(charts[0].name, "size");
  EXPECT_THAT(charts[0].svg, HasSubstr("simulations"));
}

}  // namespace
}  // namespace ifa
