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

/// What a listener would write down of a drop of `object`.
ContactSignature signatureOfADrop(const std::string& object) {
  const Body body = loadObject(object).value();
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  const auto drop = simulateDrop(body, surface, sampleInitialState(body, 3, 1), 20);
  const auto events = eventsOf(drop, audibleCut(body, surface));
  ContactSignature signature;
  for (const ContactEvent& event : events) {
    const double duration = event.filteredDuration(body.definition.mergeGap);
    signature.events.push_back({event.start - events.front().start, duration,
                                event.amplitude / events.front().amplitude,
                                duration > 0 ? event.centroid : 0, 1});
  }
  return signature;
}

TEST_F(EvaluationSet, SolvesWhatADropGave) {
  const ContactSignature signature = signatureOfADrop("Eraser");
  add("Eraser/drop.signature.json", formatSignature(signature));
  const auto evaluation = evaluate(settings_, {});
  ASSERT_TRUE(evaluation.has_value());
  const CaseOutcome& outcome = evaluation->cases.at(0);
  EXPECT_TRUE(outcome.solved) << outcome.failure;
  EXPECT_EQ(outcome.contacts, static_cast<int>(signature.events.size()));
  EXPECT_EQ(outcome.bends.size(), signature.events.size());
  EXPECT_GE(outcome.score, 0.5);
  EXPECT_GT(outcome.wallSeconds, 0);
}

TEST_F(EvaluationSet, CanBePlannedWithAWrongRestitutionAndFitted) {
  add("Eraser/drop.signature.json", formatSignature(signatureOfADrop("Eraser")));
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
  const auto json = nlohmann::json::parse(evaluationJson(*fitted));
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
  outcome.what = {"d6", "", "case", "", ""};
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
  Evaluation evaluation;
  evaluation.cases = cases;
  evaluation.total = summarize("all", cases);
  const EvaluationRow& row = evaluation.total;
  EXPECT_EQ(row.events, 700);
  EXPECT_EQ(row.good, 1);
  EXPECT_DOUBLE_EQ(row.meanGoodSeconds, 0.25);
  EXPECT_DOUBLE_EQ(row.meanScoreWithoutSound, 0.4);
  EXPECT_DOUBLE_EQ(row.arrivalBendMedian, 1.5);
  EXPECT_DOUBLE_EQ(row.arrivalBendMax, 5);
  EXPECT_THAT(evaluationMarkdown(evaluation, false), HasSubstr("| all | 700 |"));
  EXPECT_THAT(evaluationMarkdown(evaluation, false),
              HasSubstr("| 1/2 | 0.25 | 0.400 | 1.50 | 5.00 |"));
}

TEST(EvaluationReport, TellsTheSameInMarkdownAndJson) {
  Evaluation evaluation;
  evaluation.cases = {solvedCase(3, 0.8, 0.5, 1)};
  evaluation.cases[0].failure = "a | b\nc";
  evaluation.cases[0].givenRestitution = 0.5;
  evaluation.cases[0].restitution = 0.625;
  evaluation.rows = {summarize("d6", evaluation.cases)};
  evaluation.total = summarize("all", evaluation.cases);
  const std::string markdown = evaluationMarkdown(evaluation, true);
  EXPECT_THAT(markdown, HasSubstr("| d6 | none | 1 | 3.0 | 1/1 (100 %) | 1.00 | 0.800 |"));
  EXPECT_THAT(markdown, HasSubstr("| 0.62 for 0.50 | a / b c |"));
  EXPECT_THAT(evaluationMarkdown(evaluation, false), testing::Not(HasSubstr("| case |")));
  const auto json = nlohmann::json::parse(evaluationJson(evaluation));
  EXPECT_EQ(json["format"], "inverse-foley-evaluation");
  EXPECT_EQ(json["objects"][0]["mean_score"], 0.8);
  EXPECT_EQ(json["cases"][0]["bends"].size(), 3u);
  EXPECT_EQ(json["parity"], "all");
}

}  // namespace
}  // namespace ifa
