// SPDX-License-Identifier: Apache-2.0
#include "pipeline/hear.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "signature/wav_cues.h"
#include "support/clicks.h"
#include "support/midi_bytes.h"
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

TEST_F(Hear, TakesTheSoundsOwnCuePointsAndSaysSo) {
  Label first, last;
  first.start = first.end = 0.2;
  last.start = 0.45;
  last.end = 0.5;
  last.text = "non-terminal";
  const auto sound = readSound(settings_.sound).value();
  ASSERT_TRUE(writeWavWithCues(folder_ / "b.wav", settings_.sound, sound, {first, last}));
  settings_.sound = folder_ / "b.wav";
  const auto heard = hear(settings_, 0.010).value();
  ASSERT_EQ(heard.signature.events.size(), 2U);
  EXPECT_NEAR(heard.signature.events[1].time, 0.25, 1e-9);
  EXPECT_NEAR(heard.signature.events[1].duration, 0.05, 1e-9);
  EXPECT_FALSE(heard.signature.terminal);
  ASSERT_EQ(heard.remarks.size(), 1U);
  EXPECT_THAT(heard.remarks[0], HasSubstr("--ignore-cues"));
  settings_.ignoreCues = true;
  const auto detected = hear(settings_, 0.010).value();
  EXPECT_EQ(detected.signature.events.size(), 3U);
  EXPECT_TRUE(detected.remarks.empty());
  settings_.ignoreCues = false;
  settings_.labels = folder_ / "a.txt";
  test::writeClickLabels(settings_.labels, clicks_);
  EXPECT_EQ(hear(settings_, 0.010)->signature.events.size(), 3U) << "labels go before cue points";
}

TEST_F(Hear, CuePointsThatAreNoContactsAreRefusedWithTheWayOut) {
  Label early, beyond;
  early.start = early.end = 0.2;
  beyond.start = beyond.end = 1.0;
  const auto sound = readSound(settings_.sound).value();
  ASSERT_TRUE(writeWavWithCues(folder_ / "b.wav", settings_.sound, sound, {early, beyond}));
  settings_.sound = folder_ / "b.wav";
  const auto heard = hear(settings_, 0.010);
  ASSERT_FALSE(heard);
  EXPECT_EQ(heard.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(heard.error().text(), HasSubstr("b.wav, label 2"));
  EXPECT_THAT(heard.error().remedy, HasSubstr("--ignore-cues"));
}

TEST_F(Hear, ReadsMidiWithoutASound) {
  settings_.sound = folder_ / "a.mid";
  // Two of the notes are one chord, struck a little apart.
  test::writeText(settings_.sound,
                  test::midiFile(0, 500,
                                 {test::noteOn(500, 60, 100) + test::noteOn(250, 62, 25) +
                                  test::noteOn(5, 64, 50) + test::noteOn(500, 65, 50, 10)}));
  auto heard = hear(settings_, 0.010).value();
  EXPECT_FALSE(heard.sound);
  ASSERT_EQ(heard.signature.events.size(), 3U);
  EXPECT_DOUBLE_EQ(heard.signature.firstContact, 0.5);
  EXPECT_NEAR(heard.signature.events[1].time, 0.25, 1e-12);
  EXPECT_NEAR(heard.signature.events[1].amplitude, 0.5, 1e-12);
  EXPECT_EQ(heard.signature.events[1].duration, 0);
  EXPECT_TRUE(heard.signature.terminal);
  settings_.midi.channel = 10;
  EXPECT_EQ(hear(settings_, 0.010)->signature.events.size(), 1U);
  settings_.terminal = false;
  EXPECT_FALSE(hear(settings_, 0.010)->signature.terminal);
  settings_.labels = folder_ / "a.txt";
  EXPECT_EQ(hear(settings_, 0.010).error().code, ErrorCode::kUsage);
}

TEST_F(Hear, TakesLabelsOfEveryKind) {
  test::writeText(folder_ / "a.csv", "time,duration\n0.2,0\n0.45,0.03\n");
  test::writeText(folder_ / "a.json", R"({"format": "inverse-foley-signature", "version": 1,
    "first_contact": 0.2, "events": [{"time": 0}, {"time": 0.25, "amplitude": 0.9}]})");
  test::writeText(folder_ / "a.mid",
                  test::midiFile(0, 500, {test::noteOn(200, 60, 100) + test::noteOn(250, 60, 90)}));
  for (const auto& [name, amplitude] :
       {std::pair("a.csv", 0.5), std::pair("a.json", 0.9), std::pair("a.mid", 0.9)}) {
    settings_.labels = folder_ / name;
    const auto heard = hear(settings_, 0.010);
    ASSERT_TRUE(heard) << heard.error().text();
    EXPECT_TRUE(heard->sound) << name;
    ASSERT_EQ(heard->signature.events.size(), 2U) << name;
    EXPECT_NEAR(heard->signature.firstContact, 0.2, 1e-9) << name;
    EXPECT_NEAR(heard->signature.events[1].time, 0.25, 1e-9) << name;
    EXPECT_NEAR(heard->signature.events[1].amplitude, amplitude, 2e-3) << name;
  }
}

TEST_F(Hear, ReadsATableWithoutASound) {
  settings_.sound = folder_ / "a.csv";
  test::writeText(settings_.sound, "1.5,0,0.5\n1.75,0.1,0.25,non-terminal\n");
  const auto heard = hear(settings_, 0.010).value();
  ASSERT_EQ(heard.signature.events.size(), 2U);
  EXPECT_EQ(heard.signature.events[1].amplitude, 0.5);
  EXPECT_NEAR(heard.signature.events[1].centroid, 0.05, 1e-12);
  EXPECT_FALSE(heard.signature.terminal);
  for (const char* bad : {"4000\n", "2\n1\n", "1,0,0\n2,0,1\n"}) {
    test::writeText(settings_.sound, bad);
    const auto refused = hear(settings_, 0.010);
    ASSERT_FALSE(refused) << bad;
    EXPECT_THAT(refused.error().text(), HasSubstr("a.csv"));
  }
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
