// SPDX-License-Identifier: Apache-2.0
#include "pipeline/hear.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

class Hear : public testing::Test {
 protected:
  void SetUp() override {
    settings_.sound = folder_ / "a.wav";
    test::writeClicks(settings_.sound, clicks_, 1.0);
  }
  const std::vector<test::Click> clicks_ = {{0.2, 0.8}, {0.45, 0.4}, {0.6, 0.2}};
  test::TemporaryFolder folder_;
  SynchronizeSettings settings_;
};

TEST_F(Hear, TakesContactsFromLabels) {
  settings_.labels = folder_ / "a.txt";
  test::writeClickLabels(settings_.labels, clicks_);
  const auto heard = hear(settings_, 0.010).value();
  ASSERT_EQ(heard.signature.events.size(), 3U);
  EXPECT_DOUBLE_EQ(heard.signature.firstContact, 0.2);
  EXPECT_NEAR(heard.signature.events[1].time, 0.25, 1e-12);
  EXPECT_NEAR(heard.signature.events[1].amplitude, 0.5, 1e-3);
  EXPECT_TRUE(heard.signature.terminal);
}

TEST_F(Hear, DetectsContactsWhereThereAreNoLabels) {
  const auto heard = hear(settings_, 0.010).value();
  ASSERT_EQ(heard.signature.events.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(heard.signature.firstContact + heard.signature.events[i].time, clicks_[i].time,
                0.002);
  }
}

TEST_F(Hear, LeavesTheEndingToTheUser) {
  settings_.terminal = false;
  EXPECT_FALSE(hear(settings_, 0.010).value().signature.terminal);
}

TEST_F(Hear, ReadsASignatureWithoutASound) {
  settings_.sound = folder_ / "s.json";
  test::writeText(settings_.sound,
                  R"({"format": "inverse-foley-signature", "version": 1, "terminal": false,
    "events": [{"time": 0, "duration": 0, "amplitude": 1, "centroid": 0, "weight": 1},
               {"time": 0.3, "duration": 0, "amplitude": 0.5, "centroid": 0, "weight": 1}]})");
  const auto heard = hear(settings_, 0.010).value();
  EXPECT_FALSE(heard.sound);
  EXPECT_EQ(heard.signature.events.size(), 2U);
  EXPECT_FALSE(heard.signature.terminal);
}

TEST_F(Hear, RefusesLabelsBesideASignature) {
  settings_.sound = folder_ / "s.json";
  settings_.labels = folder_ / "a.txt";
  const auto heard = hear(settings_, 0.010);
  ASSERT_FALSE(heard);
  EXPECT_EQ(heard.error().code, ErrorCode::kUsage);
}

TEST_F(Hear, NamesTheFileThatIsWrong) {
  settings_.labels = folder_ / "a.txt";
  test::writeText(settings_.labels, "0.2\t0.2\thit\n5.0\t5.0\tterminal\n");
  auto heard = hear(settings_, 0.010);
  ASSERT_FALSE(heard);
  EXPECT_EQ(heard.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(heard.error().place, HasSubstr("a.txt"));
  settings_.labels.clear();
  settings_.sound = folder_ / "none.wav";
  heard = hear(settings_, 0.010);
  ASSERT_FALSE(heard);
  EXPECT_THAT(heard.error().place, HasSubstr("none.wav"));
}

TEST(WithLeadingSilence, MovesAllChannels) {
  Sound sound;
  sound.rate = 10;
  sound.channels = 2;
  sound.samples = {1, 2};
  sound.interleaved = {1, 1, 2, 2};
  const Sound padded = withLeadingSilence(sound, 3);
  EXPECT_EQ(padded.samples, (std::vector<float>{0, 0, 0, 1, 2}));
  EXPECT_EQ(padded.interleaved, (std::vector<float>{0, 0, 0, 0, 0, 0, 1, 1, 2, 2}));
  sound.interleaved.clear();
  EXPECT_TRUE(withLeadingSilence(sound, 3).interleaved.empty());
}

}  // namespace
}  // namespace ifa
