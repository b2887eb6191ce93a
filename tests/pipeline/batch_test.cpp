// SPDX-License-Identifier: Apache-2.0
#include "pipeline/batch.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

TEST(FindSounds, TakesSoundsAndSignaturesWithTheirLabels) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b.WAV", "b.txt", "a.flac", "notes.txt", "c.signature.json", "c.txt",
                           "known.json", "picture.png"}) {
    test::writeText(folder / name, "");
  }
  std::filesystem::create_directory(folder / "d.wav");
  const auto items = findSounds(folder.path()).value();
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[0].name, "a");
  EXPECT_TRUE(items[0].labels.empty());
  EXPECT_EQ(items[1].name, "b");
  EXPECT_EQ(items[1].labels, folder / "b.txt");
  EXPECT_EQ(items[2].name, "c");
  EXPECT_TRUE(items[2].labels.empty()) << "a signature has its contacts already";
}

TEST(FindSounds, TakesMidiAsASoundOrAsLabelsOfOne) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.mid", "b.wav", "b.mid", "c.wav", "c.csv", "c.mid", "d.MIDI"}) {
    test::writeText(folder / name, "");
  }
  const auto items = findSounds(folder.path()).value();
  ASSERT_EQ(items.size(), 4U);
  EXPECT_EQ(items[0].sound, folder / "a.mid");
  EXPECT_TRUE(items[0].labels.empty());
  EXPECT_EQ(items[1].name, "b");
  EXPECT_EQ(items[1].labels, folder / "b.mid");
  EXPECT_EQ(items[2].labels, folder / "c.csv");
  EXPECT_EQ(items[3].sound, folder / "d.MIDI");
}

TEST(FindSounds, KeepsSoundsOfTheSameStemApart) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.wav", "a.ogg", "b.wav"}) test::writeText(folder / name, "");
  const auto items = findSounds(folder.path()).value();
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[0].name, "a.ogg");
  EXPECT_EQ(items[1].name, "a.wav");
  EXPECT_EQ(items[2].name, "b");
}

TEST(FindSounds, SaysThatThereIsNone) {
  const test::TemporaryFolder folder;
  const auto none = findSounds(folder.path());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kBadInput);
  EXPECT_FALSE(findSounds(folder / "missing"));
}

TEST(SynchronizeAll, DoesAgainWhatLacksAFileThatIsAskedFor) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "a.signature.json", R"({"format": "inverse-foley-signature",
      "version": 1, "terminal": false,
      "events": [{"time": 0, "duration": 0, "amplitude": 1, "centroid": 0, "weight": 1}]})");
  SynchronizeSettings settings;
  settings.object = "Eraser";
  const auto items = findSounds(folder.path()).value();
  const auto outcome = [&](const OutputSettings& output) {
    return synchronizeAll(items, settings, folder / "out", output, {}, nullptr).front().outcome;
  };
  OutputSettings output{{OutputFormat::kJson}, {}, false};
  EXPECT_EQ(outcome(output), BatchOutcome::kSolved);
  EXPECT_EQ(outcome(output), BatchOutcome::kSkipped);
  output.formats.insert(OutputFormat::kGlb);
  EXPECT_EQ(outcome(output), BatchOutcome::kSolved);
  EXPECT_EQ(outcome(output), BatchOutcome::kSkipped);
  settings.fit = true;
  EXPECT_EQ(outcome(output), BatchOutcome::kSolved);
  EXPECT_EQ(outcome(output), BatchOutcome::kSkipped);
  settings.restitution = 0.3;
  EXPECT_EQ(outcome(output), BatchOutcome::kSolved);
  EXPECT_EQ(outcome(output), BatchOutcome::kSkipped);
  settings.orientations = {{0, "", {0, 0, 1}, {0, 0, 1}}};
  EXPECT_EQ(outcome(output), BatchOutcome::kSolved);
  EXPECT_EQ(outcome(output), BatchOutcome::kSkipped);
}

}  // namespace
}  // namespace ifa
