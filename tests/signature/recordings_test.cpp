// SPDX-License-Identifier: Apache-2.0
// Detection against the labels of real recordings, found through IFA_RECORDINGS
// (docs/detection.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "signature/labels.h"
#include "signature/signature.h"
#include "sound/detection_score.h"
#include "sound/onset_detector.h"

namespace ifa {
namespace {

constexpr double kMergeGap = 0.010;

std::vector<double> mergedStarts(const std::vector<Label>& labels) {
  std::vector<double> starts;
  for (const Label& label : mergeLabels(labels, kMergeGap)) starts.push_back(label.start);
  return starts;
}

std::vector<std::filesystem::path> soundsIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> sounds;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".wav") sounds.push_back(entry.path());
  }
  std::sort(sounds.begin(), sounds.end());
  return sounds;
}

class Recordings : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("IFA_RECORDINGS");
    if (folder == nullptr) GTEST_SKIP() << "IFA_RECORDINGS is not set: no recordings to listen to";
    root_ = folder;
  }

  test::DetectionScore scoreOf(const char* folder, double tolerance) const {
    test::DetectionScore score;
    for (const auto& path : soundsIn(root_ / folder)) {
      const auto sound = readSound(path);
      const auto labels = readLabels(std::filesystem::path(path).replace_extension(".txt"));
      EXPECT_TRUE(sound && labels) << path;
      const auto contacts = detectContacts(*sound);
      EXPECT_TRUE(contacts) << path;
      if (!contacts) continue;
      score.add(test::scoreDetection(mergedStarts(*labels),
                                     mergedStarts(labelsFromContacts(*contacts)), tolerance));
    }
    return score;
  }

  std::filesystem::path root_;
};

TEST_F(Recordings, SingleDice) {
  const auto score = scoreOf("single", 0.010);
  EXPECT_GT(score.found, 150U);
  // Required: 0.80. Reached: 0.972; a change that loses two hundredths should be looked at.
  EXPECT_GE(score.fMeasure(), 0.95);
  EXPECT_LT(score.medianError(), 0.0005);
  EXPECT_GE(scoreOf("single", 0.005).fMeasure(), 0.94);
}

TEST_F(Recordings, DoubtfulAndOtherThings) {
  // Reached: 0.964 and 0.963.
  EXPECT_GE(scoreOf("doubtful", 0.010).fMeasure(), 0.94);
  EXPECT_GE(scoreOf("other", 0.010).fMeasure(), 0.94);
}

TEST_F(Recordings, TheLastContactIsFoundWithItsEnd) {
  int found = 0, ends = 0;
  for (const auto& path : soundsIn(root_)) {
    const auto sound = readSound(path);
    const auto labels = readLabels(std::filesystem::path(path).replace_extension(".txt"));
    ASSERT_TRUE(sound && labels) << path;
    const auto contacts = detectContacts(*sound);
    ASSERT_TRUE(contacts) << path;
    const Label last = mergeLabels(*labels, kMergeGap).back();
    const Label heard = mergeLabels(labelsFromContacts(*contacts), kMergeGap).back();
    if (std::abs(heard.start - last.start) > kMergeGap) continue;
    ++found;
    ends += std::abs(heard.end - last.end) <= 0.040 ? 1 : 0;
  }
  // Of 30; reached: 27 and 26 (docs/detection.md tells of the others).
  EXPECT_GE(found, 27);
  EXPECT_GE(ends, 26);
}

TEST_F(Recordings, LabelsGiveSignatures) {
  for (const char* folder : {"single", "doubtful", "other"}) {
    for (const auto& path : soundsIn(root_ / folder)) {
      const auto sound = readSound(path);
      const auto file = std::filesystem::path(path).replace_extension(".txt");
      const auto labels = readLabels(file);
      ASSERT_TRUE(sound && labels) << path;
      const auto signature = signatureFromLabels(*sound, *labels, {}, file.string());
      ASSERT_TRUE(signature) << signature.error().text();
      EXPECT_TRUE(signature->terminal);
      EXPECT_EQ(signature->events.front().amplitude, 1);
      for (std::size_t i = 1; i < signature->events.size(); ++i) {
        const auto& before = signature->events[i - 1];
        EXPECT_GE(signature->events[i].time - before.time - before.duration, kMergeGap - 1e-6);
        EXPECT_GT(signature->events[i].amplitude, 0);
      }
    }
  }
}

}  // namespace
}  // namespace ifa
