// SPDX-License-Identifier: Apache-2.0
// The public interface: what a program that links the library sees.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "ifa/ifa.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

constexpr const char* kRhythm = R"({"format": "inverse-foley-signature", "version": 1,
  "terminal": true, "events": [
    {"time": 0, "duration": 0, "amplitude": 1, "centroid": 0, "weight": 1},
    {"time": 0.2, "duration": 0, "amplitude": 0.6, "centroid": 0, "weight": 1},
    {"time": 0.3, "duration": 0.06, "amplitude": 0.5, "centroid": 0.02, "weight": 1}]})";

class Synchronize : public testing::Test {
 protected:
  void SetUp() override {
    settings_.sound = folder_ / "rhythm.json";
    settings_.object = "Eraser";
    test::writeText(settings_.sound, kRhythm);
  }
  test::TemporaryFolder folder_;
  SynchronizeSettings settings_;
};

TEST_F(Synchronize, FindsAMotionForASignature) {
  const auto result = synchronize(settings_);
  ASSERT_TRUE(result) << result.error().text();
  const Motion& motion = result->takes.front();
  EXPECT_TRUE(motion.success) << motion.failure;
  ASSERT_EQ(motion.contacts.size(), 3U);
  EXPECT_NEAR(motion.contacts[1].time, 0.2, 1e-4);
  EXPECT_NEAR(motion.contacts[2].time, 0.3, 1e-4);
  EXPECT_TRUE(motion.contacts[2].terminal);
  EXPECT_TRUE(motion.sound.file.empty());
  EXPECT_NEAR(motion.sound.firstContact, -motion.trajectory.front().time, 1e-12);
}

TEST_F(Synchronize, RefusesSettingsThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SynchronizeSettings> all(11, settings_);
  all[0].takes = 0;
  all[1].takes = kMaxTakes + 1;
  all[2].timeLimitSeconds = nan;
  all[3].energyGain = -0.1;
  all[4].preRollSeconds = std::numeric_limits<double>::infinity();
  all[5].planner = "chance";
  all[6].graph.earlyExit = nan;
  all[7].restitution = 0.96;
  all[8].restitution = nan;
  all[9].restitutionScale = 0;
  all[10].fit = true;
  all[10].planner = "graph";
  for (const auto& settings : all) {
    const auto result = synchronize(settings);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUsage) << result.error().text();
  }
}

// A cup that rolls unheard for 406 ms and then stops at once: no rolling has such a rhythm, on a
// surface that is deader than it was least of all.
TEST_F(Synchronize, SlowlyEasesEnergyAndTimeRatherThanFindNothing) {
  settings_.sound = std::filesystem::path(IFA_SOURCE_DIR) /
                    "tests/evaluation/CoffeeCup/CoffeeCup-10.signature.json";
  settings_.object = "CoffeeCup";
  settings_.restitution = 0.35;
  const auto result = synchronize(settings_);
  ASSERT_TRUE(result) << result.error().text();
  const Motion& motion = result->takes.front();
  EXPECT_TRUE(motion.success) << motion.failure;  // its audit holds
  EXPECT_EQ(motion.energyGain, 0.1);
  const auto warped = [](const MotionContact& contact) { return contact.retiming != 1; };
  EXPECT_TRUE(std::any_of(motion.contacts.begin(), motion.contacts.end(), warped));
  for (const MotionContact& contact : motion.contacts) {
    EXPECT_NEAR(contact.time, contact.targetTime, 1e-9);
  }
}

TEST_F(Synchronize, FitsTheRestitution) {
  settings_.fit = true;
  settings_.restitutionScale = 0.7;
  const auto result = synchronize(settings_);
  ASSERT_TRUE(result) << result.error().text();
  const Motion& motion = result->takes.front();
  EXPECT_TRUE(motion.success) << motion.failure;  // its audit holds
  ASSERT_TRUE(motion.given);
  EXPECT_EQ(motion.given->surface, "desk");
  EXPECT_NEAR(motion.given->restitution, 0.7 * 0.338, 1e-9);
  for (const MotionContact& contact : motion.contacts) {
    EXPECT_NEAR(contact.restitution, motion.object.restitution,
                0.2 * motion.object.restitution + 1e-9);
  }
}

class SynchronizeByGraph : public Synchronize {
 protected:
  void SetUp() override {
    Synchronize::SetUp();
    settings_.planner = "graph";
    settings_.graph.simulations = 2000;
  }
};

TEST_F(SynchronizeByGraph, MakesTheDatabaseThatIsMissing) {
  const auto result = synchronize(settings_);
  ASSERT_TRUE(result) << result.error().text();
  const Motion& motion = result->takes.front();
  EXPECT_TRUE(motion.success) << motion.failure;  // its audit holds
  EXPECT_EQ(motion.planner, "graph");
  ASSERT_EQ(motion.contacts.size(), 3U);
  for (const MotionContact& contact : motion.contacts) {
    EXPECT_NEAR(contact.time, contact.targetTime, 1e-4);
    EXPECT_LT(contact.source.simulation, 2000);
  }
  ASSERT_TRUE(motion.database);
  EXPECT_EQ(motion.database->simulations, 2000);
  EXPECT_GT(motion.database->events, 2000);
  EXPECT_EQ(motion.database->hash.size(), 16U);
}

TEST_F(SynchronizeByGraph, TakesThePapersCut) {
  const auto audible = synchronize(settings_);
  settings_.graph.cut = EventCut::kPaper;
  settings_.graph.timeWarp = settings_.graph.printedVelocity = true;
  const auto result = synchronize(settings_);
  ASSERT_TRUE(result) << result.error().text();
  const Motion& motion = result->takes.front();
  EXPECT_TRUE(motion.success) << motion.failure;  // its audit holds
  EXPECT_EQ(motion.cut, EventCut::kPaper);
  ASSERT_TRUE(audible && motion.database);
  EXPECT_EQ(audible->takes.front().cut, EventCut::kAudible);
  EXPECT_NE(motion.database->hash, audible->takes.front().database->hash);
}

TEST_F(SynchronizeByGraph, ShowsBlendsAtAnotherPace) {
  test::writeText(settings_.sound, R"({"format": "inverse-foley-signature", "version": 1,
  "terminal": false, "events": [
    {"time": 0, "duration": 0, "amplitude": 1, "centroid": 0, "weight": 1},
    {"time": 0.11, "duration": 0, "amplitude": 0.6, "centroid": 0, "weight": 1},
    {"time": 0.15, "duration": 0, "amplitude": 0.4, "centroid": 0, "weight": 1}]})");
  settings_.graph.timeWarp = true;
  settings_.graph.printedVelocity = true;
  const auto result = synchronize(settings_);
  ASSERT_TRUE(result) << result.error().text();
  const Motion& motion = result->takes.front();
  EXPECT_TRUE(motion.success) << motion.failure;
  const auto warped = [](const MotionContact& contact) { return contact.retiming != 1; };
  EXPECT_TRUE(std::any_of(motion.contacts.begin(), motion.contacts.end(), warped));
}

TEST_F(Synchronize, EndsWhenItIsAskedTo) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const auto result = synchronizeToFolder(settings_, folder_ / "out", {}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
  EXPECT_THAT(folder_.names(), testing::ElementsAre("rhythm.json"));
}

TEST_F(Synchronize, LooksForObjectsWhereItIsTold) {
  std::filesystem::create_directory(folder_ / "library");
  test::writeText(folder_ / "library/Eraser.json", "{");
  settings_.objects = folder_ / "library";
  const auto result = synchronize(settings_);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().place, HasSubstr((folder_ / "library/Eraser.json").string()));
}

TEST_F(Synchronize, ReportsStagesInOrder) {
  std::vector<std::string> stages;
  Progress progress;
  progress.report = [&](std::string_view stage, double share) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
  };
  ASSERT_TRUE(synchronize(settings_, progress));
  EXPECT_THAT(stages, testing::Contains("search"));
}

}  // namespace
}  // namespace ifa
