// SPDX-License-Identifier: Apache-2.0
#include "pipeline/choose_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <limits>

#include "base/file.h"
#include "body/object_file.h"
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
  EXPECT_GT(ranking->front().probability, 0.9);
  EXPECT_NEAR(ranking->front().probability + ranking->back().probability, 1, 1e-12);
  EXPECT_FALSE(ranking->back().reason.empty());
  EXPECT_THAT(asGoodAsBest(*ranking), ElementsAre("Eraser"));
}

TEST(ChooseObject, IsInDoubtBetweenEquals) {
  const ObjectRanking ranking = {{"d6", true, true, 0.95, 0.5, ""},
                                 {"d8", true, true, 0.94, 0.3, ""},
                                 {"Nut", true, true, 0.9, 0.05, ""},
                                 {"Eraser", true, false, 0, 0.15, "no"}};
  EXPECT_THAT(asGoodAsBest(ranking), ElementsAre("d6", "d8"));
}

TEST(RhythmProbabilities, SumToOneWhateverTheDensities) {
  const double never = -std::numeric_limits<double>::infinity();
  EXPECT_THAT(rhythmProbabilities({3, 3}), ElementsAre(0.5, 0.5));
  EXPECT_THAT(rhythmProbabilities({-1e300, never}), ElementsAre(1, 0));
  EXPECT_THAT(rhythmProbabilities({never, never}), ElementsAre(0.5, 0.5));
  const auto two = rhythmProbabilities({-100, -110});
  EXPECT_GT(two[0], 0.9);
  EXPECT_NEAR(two[0] + two[1], 1, 1e-15);
}

TEST(ChooseObject, RefusesWhatIsNoObject) {
  const auto ranking = chooseObject(settingsFor(""), {"d6", "d7"}, {});
  ASSERT_FALSE(ranking.has_value());
  EXPECT_THAT(ranking.error().text(), HasSubstr("d7"));
  EXPECT_FALSE(synchronize(settingsFor(",")).has_value());
}

TEST(ChooseObject, LeavesOutWhatIsUnlikelyByFar) {
  const auto ranking =
      chooseObject(settingsFor(""), {"d20", "d12", "d10", "d8", "d6", "d4", "Eraser"}, {});
  ASSERT_TRUE(ranking.has_value()) << ranking.error().text();
  ASSERT_EQ(ranking->size(), 7U);
  EXPECT_EQ(ranking->front().object, "Eraser");
  EXPECT_LE(std::count_if(ranking->begin(), ranking->end(),
                          [](const ObjectRank& one) { return one.planned; }),
            5);
  double sum = 0;
  for (const ObjectRank& one : *ranking) sum += one.probability;
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(ChooseObject, PutsAsideWhatLacksTheSurface) {
  const test::TemporaryFolder folder;
  SynchronizeSettings settings = settingsFor("");
  settings.surface = "moon";
  const auto none = chooseObject(settings, {"d6", "Eraser"}, {});
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().text(), HasSubstr("moon"));
  std::string text = *readFile(objectsFolder() / "Eraser.json", 1 << 16);
  const auto at = text.find("\"desk\"", text.find("\"surfaces\""));
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 6, "\"moon\"");
  text.replace(text.find("\"default_surface\": \"desk\""), 25, "\"default_surface\": \"moon\"");
  test::writeText(folder / "there.json", text);
  for (const char* name : {"Eraser.obj", "Eraser.mtl"}) {
    std::filesystem::copy(objectsFolder() / name, folder / name);
  }
  const auto one = chooseObject(settings, {"d6", (folder / "there.json").string()}, {});
  ASSERT_TRUE(one.has_value()) << one.error().text();
  EXPECT_FALSE(one->back().planned);
  EXPECT_THAT(one->back().reason, HasSubstr("no surface"));
  EXPECT_EQ(one->front().probability, 1);
}

TEST(ChooseObject, PutsAsideWhatLacksTheFace) {
  SynchronizeSettings settings = settingsFor("");
  settings.orientations = {{0, "6", {0, 0, 1}, {0, 0, 1}}};
  const auto ranking = chooseObject(settings, {"Eraser", "d6"}, {});
  ASSERT_TRUE(ranking.has_value()) << ranking.error().text();
  EXPECT_EQ(ranking->front().object, "d6");
  EXPECT_EQ(ranking->back().object, "Eraser");
  EXPECT_FALSE(ranking->back().planned);
  EXPECT_THAT(ranking->back().reason, HasSubstr("no face"));
  EXPECT_THAT(chooseObject(settings, {"Eraser"}, {}).error().text(), HasSubstr("no face"));
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
