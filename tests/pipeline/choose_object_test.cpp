// SPDX-License-Identifier: Apache-2.0
#include "pipeline/choose_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Of an eraser in the evaluation set: four contacts.
std::filesystem::path eraserSound() {
  return std::filesystem::path(IFA_SOURCE_DIR) / "tests/evaluation/Eraser/Eraser-02.signature.json";
}

SynchronizeSettings settingsFor(const std::string& objects) {
  SynchronizeSettings settings;
  settings.sound = eraserSound();
  settings.object = objects;
  settings.planner = "shoot";
  return settings;
}

TEST(CandidateObjects, AreTheLibraryOrAList) {
  const auto all = candidateObjects("auto");
  ASSERT_TRUE(all.has_value());
  EXPECT_GE(all->size(), 10U);
  EXPECT_THAT(candidateObjects("d6,Nut,").value(), ElementsAre("d6", "Nut"));
  EXPECT_THAT(candidateObjects("d6").value(), IsEmpty());
  const test::TemporaryFolder folder;
  const auto file = folder / "a,b.json";
  test::writeText(file, "{}");
  EXPECT_THAT(candidateObjects(file.string()).value(), IsEmpty());  // a file of that very name
}

TEST(ChooseObject, PrefersWhatMadeTheSound) {
  const auto ranking = chooseObject(settingsFor(""), {"d6", "Eraser"}, {});
  ASSERT_TRUE(ranking.has_value()) << ranking.error().text();
  ASSERT_EQ(ranking->size(), 2U);
  EXPECT_EQ(ranking->front().object, "Eraser");
  EXPECT_TRUE(ranking->front().solved);
  EXPECT_EQ(ranking->front().behind, 0);
  EXPECT_FALSE(ranking->back().reason.empty());
  EXPECT_GE(ranking->front().score, ranking->back().score);
  EXPECT_THAT(asGoodAsBest(*ranking), ElementsAre("Eraser"));
}

TEST(ChooseObject, IsInDoubtBetweenEquals) {
  const ObjectRanking ranking = {{"d6", true, 0.95, 0, ""},
                                 {"d8", true, 0.94, 1.2, ""},
                                 {"Nut", true, 0.9, 6, ""},
                                 {"Eraser", false, 0, 0, "no"}};
  EXPECT_THAT(asGoodAsBest(ranking), ElementsAre("d6", "d8"));
}

TEST(ChooseObject, RefusesWhatIsNoObject) {
  const auto ranking = chooseObject(settingsFor(""), {"d6", "d7"}, {});
  ASSERT_FALSE(ranking.has_value());
  EXPECT_THAT(ranking.error().text(), HasSubstr("d7"));
  EXPECT_FALSE(synchronize(settingsFor(",")).has_value());
}

TEST(ChooseObject, CanBeInterrupted) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const auto ranking = chooseObject(settingsFor(""), {"d6", "Nut"}, progress);
  ASSERT_FALSE(ranking.has_value());
  EXPECT_EQ(ranking.error().code, ErrorCode::kInterrupted);
}

TEST(ChooseObject, IsPartOfSynchronising) {
  const auto result = synchronize(settingsFor("d6,Eraser"));
  ASSERT_TRUE(result.has_value()) << result.error().text();
  EXPECT_EQ(result->takes.front().object.name, "Eraser");
  ASSERT_EQ(result->ranking.size(), 2U);
  EXPECT_EQ(result->ranking.front().score, result->takes.front().score);
}

}  // namespace
}  // namespace ifa
