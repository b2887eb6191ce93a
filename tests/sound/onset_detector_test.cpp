// SPDX-License-Identifier: Apache-2.0
#include "sound/onset_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "sound/detection_score.h"
#include "sound/synthetic_sound.h"

namespace ifa {
namespace {

using test::Burst;

std::vector<double> startsOf(const std::vector<DetectedContact>& contacts) {
  std::vector<double> starts;
  for (const DetectedContact& contact : contacts) starts.push_back(contact.start);
  return starts;
}

/// A bouncing thing: gaps that shrink, hits that get softer.
std::vector<Burst> bounces() {
  std::vector<Burst> bursts;
  double time = 0.1, gap = 0.18, amplitude = 0.8;
  for (int i = 0; i < 12; ++i) {
    bursts.push_back({time, amplitude, 0.004});
    time += gap;
    gap *= 0.82;
    amplitude *= 0.8;
  }
  return bursts;
}

std::vector<double> timesOf(const std::vector<Burst>& bursts) {
  std::vector<double> times;
  for (const Burst& burst : bursts) times.push_back(burst.time);
  return times;
}

class FindsBursts : public testing::TestWithParam<int> {};

TEST_P(FindsBursts, AllOfThemAndNothingElse) {
  for (const double noise : {0.0, 1e-4, 3e-3}) {
    const auto sound = test::burstsInNoise(bounces(), 1.5, GetParam(), noise);
    const auto contacts = detectContacts(sound);
    ASSERT_TRUE(contacts) << contacts.error().text();
    const auto score = test::scoreDetection(timesOf(bounces()), startsOf(*contacts), 0.002);
    EXPECT_EQ(score.missed, 0U) << "noise " << noise;
    EXPECT_EQ(score.invented, 0U) << "noise " << noise;
    EXPECT_LT(score.medianError(), 0.0006) << "noise " << noise;
    EXPECT_EQ(contacts->back().end, contacts->back().start) << "a click is no rattle";
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, FindsBursts, testing::Values(16000, 44100, 48000, 96000, 192000));

TEST(DetectContacts, DoesNotDependOnTheVolume) {
  auto sound = test::burstsInNoise(bounces(), 1.5, 44100, 1e-4);
  const auto loud = detectContacts(sound);
  for (float& sample : sound.samples) sample *= 0.01F;
  const auto soft = detectContacts(sound);
  ASSERT_TRUE(loud && soft);
  EXPECT_EQ(startsOf(*loud), startsOf(*soft));
}

TEST(DetectContacts, TellsHitsInAReverberantRoom) {
  // A diffuse tail of 0.25 s (RT60) under every hit, 15 dB down.
  auto bursts = bounces();
  const auto truth = timesOf(bursts);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    bursts.push_back({bursts[i].time, 0.18 * bursts[i].amplitude, 0.036});
  }
  const auto contacts = detectContacts(test::burstsInNoise(bursts, 1.5, 48000, 1e-4));
  ASSERT_TRUE(contacts);
  EXPECT_GE(test::scoreDetection(truth, startsOf(*contacts), 0.005).fMeasure(), 0.95);
}

TEST(DetectContacts, LeavesOutFaintEchoes) {
  // A click 21 ms and another 35 ms after each hit, 18 dB down, in a tail that covers them.
  std::vector<Burst> bursts;
  for (const double time : {0.1, 0.4, 0.7}) {
    bursts.push_back({time, 0.8, 0.012});
    bursts.push_back({time + 0.021, 0.1, 0.002});
    bursts.push_back({time + 0.035, 0.05, 0.002});
  }
  const auto contacts = detectContacts(test::burstsInNoise(bursts, 1, 48000, 1e-4));
  ASSERT_TRUE(contacts);
  EXPECT_EQ(contacts->size(), 3U);
}

TEST(DetectContacts, HearsAnAttackAtTheVeryStart) {
  const auto contacts = detectContacts(test::burstsInNoise({{0.0}, {0.2}}, 0.5, 44100, 1e-4));
  ASSERT_TRUE(contacts);
  ASSERT_EQ(contacts->size(), 2U);
  EXPECT_NEAR(contacts->front().start, 0, 0.0005);
}

TEST(DetectContacts, TakesAHandNoiseBeforeTheThrowForNoContact) {
  const auto contacts =
      detectContacts(test::burstsInNoise({{0.05, 0.01}, {0.3, 0.9}, {0.5, 0.01}}, 1, 44100, 1e-5));
  ASSERT_TRUE(contacts);
  ASSERT_EQ(contacts->size(), 2U);
  EXPECT_NEAR(contacts->front().start, 0.3, 0.001);
}

TEST(DetectContacts, TheLastContactMayBeARattle) {
  std::vector<Burst> bursts{{0.1, 0.8}, {0.3, 0.5}};
  for (int i = 0; i < 12; ++i) bursts.push_back({0.45 + 0.012 * i, 0.1, 0.009});
  const auto contacts = detectContacts(test::burstsInNoise(bursts, 1, 44100, 1e-4));
  ASSERT_TRUE(contacts);
  EXPECT_NEAR(contacts->back().end, 0.45 + 0.012 * 11, 0.025);
  for (std::size_t i = 0; i + 1 < contacts->size(); ++i) {
    EXPECT_EQ((*contacts)[i].end, (*contacts)[i].start);
  }
}

TEST(DetectContacts, ARattleSwallowsWhatIsInIt) {
  // Hits 9 ms apart, many of which would be contacts by themselves.
  std::vector<Burst> bursts{{0.1, 0.8}, {0.3, 0.5}};
  for (int i = 0; i < 16; ++i) bursts.push_back({0.45 + 0.009 * i, i == 0 ? 0.1 : 0.07, 0.003});
  const auto contacts = detectContacts(test::burstsInNoise(bursts, 1, 44100, 1e-4));
  ASSERT_TRUE(contacts);
  ASSERT_EQ(contacts->size(), 3U);
  EXPECT_NEAR(contacts->back().start, 0.45, 0.001);
  EXPECT_NEAR(contacts->back().end, 0.45 + 0.009 * 15, 0.03);
}

/// Three knocks, each followed by soft hits, on something that rolls (noise) after two real
/// contacts.
std::vector<Burst> knocksAndSoftHits(double knockGap, double softGap) {
  std::vector<Burst> bursts{{0.1, 0.8}, {0.3, 0.5}};
  for (int i = 0; i < 3; ++i) {
    const double time = 0.45 + knockGap * i;
    bursts.push_back({time, 0.03});
    for (int j = 1; j <= 4; ++j) bursts.push_back({time + softGap * j, 0.017});
  }
  return bursts;
}

TEST(DetectContacts, KnocksWithSoftHitsBetweenAreOneRattle) {
  const auto contacts =
      detectContacts(test::burstsInNoise(knocksAndSoftHits(0.1, 0.02), 1, 44100, 0.01));
  ASSERT_TRUE(contacts);
  ASSERT_EQ(contacts->size(), 3U);
  EXPECT_NEAR(contacts->back().start, 0.45, 0.001);
  EXPECT_NEAR(contacts->back().end, 0.65 + 0.08, 0.025);
}

TEST(DetectContacts, KnocksWithAFlightBetweenAreTold) {
  // The same, but nothing touches in the last 0.1 s before a knock.
  const auto contacts =
      detectContacts(test::burstsInNoise(knocksAndSoftHits(0.18, 0.02), 1.2, 44100, 0.01));
  ASSERT_TRUE(contacts);
  ASSERT_EQ(contacts->size(), 5U);
  EXPECT_NEAR(contacts->back().start, 0.45 + 0.36, 0.001);
}

TEST(DetectContacts, WhatComesAfterTheLastAttackMayRiseLess) {
  DetectorSettings settings;
  settings.minRise = 16;
  settings.lastEase = 0;
  // Rises of about 30 dB, but for the second and the last.
  const auto sound =
      test::burstsInNoise({{0.1, 0.9}, {0.2, 0.1}, {0.3, 0.9}, {0.4, 0.1}}, 0.6, 44100, 0.02);
  const auto strict = detectContacts(sound, settings);
  settings.lastEase = 8;
  const auto eased = detectContacts(sound, settings);
  ASSERT_TRUE(strict && eased);
  ASSERT_EQ(strict->size(), 2U);
  ASSERT_EQ(eased->size(), 3U);
  EXPECT_NEAR(eased->back().start, 0.4, 0.001);
}

TEST(DetectContacts, TwoSoftHitsAreNoRattle) {
  // Two rises of 4 dB, 25 ms apart, in the tail of the last contact.
  const auto contacts = detectContacts(test::burstsInNoise(
      {{0.1, 0.8}, {0.4, 0.5, 0.012}, {0.425, 0.2, 0.004}, {0.45, 0.025, 0.004}}, 0.8, 44100,
      1e-4));
  ASSERT_TRUE(contacts);
  for (const DetectedContact& contact : *contacts) EXPECT_EQ(contact.end, contact.start);
}

/// Hits that get softer, the last ones hardly louder than the noise after them.
std::vector<Burst> fadingHits() {
  return {{0.2, 0.8}, {0.4, 0.4}, {0.55, 0.2}, {0.65, 0.1}, {0.72, 0.065}};
}

TEST(DetectContacts, ASoftLastContactIsHeardInSteadyNoise) {
  DetectorSettings settings;
  settings.falseAlarm = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto sound = test::burstsInNoise(fadingHits(), 2, 44100, 0.04, seed);
    const auto strict = detectContacts(sound, settings), contacts = detectContacts(sound);
    ASSERT_TRUE(strict && contacts);
    EXPECT_EQ(strict->size(), 4U);
    ASSERT_EQ(contacts->size(), 5U);
    EXPECT_NEAR(contacts->back().start, 0.72, 0.002);
    EXPECT_LT(contacts->back().rise, DetectorSettings().minRise);
    EXPECT_GT(contacts->back().confidence, 0.5);
    EXPECT_LE(contacts->back().confidence, 0.9) << "a motion may leave it out";
    for (std::size_t i = 0; i < strict->size(); ++i) {
      EXPECT_EQ((*contacts)[i].start, (*strict)[i].start);
      EXPECT_EQ((*contacts)[i].end, (*strict)[i].end);
    }
  }
}

TEST(DetectContacts, NoiseAloneAddsNoSoftContact) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto contacts = detectContacts(test::burstsInNoise({{0.2, 0.8}}, 20, 44100, 0.05, seed));
    ASSERT_TRUE(contacts);
    EXPECT_EQ(contacts->size(), 1U);
  }
}

TEST(DetectContacts, ARecordingThatBeginsAmidNoiseDoesNotBeginWithAContact) {
  for (const int rate : {16000, 44100}) {
    const auto contacts = detectContacts(test::burstsInNoise({{0.3}, {0.5}}, 1, rate, 0.1));
    ASSERT_TRUE(contacts);
    EXPECT_EQ(contacts->size(), 2U);
    EXPECT_NEAR(contacts->front().start, 0.3, 0.001);
  }
}

TEST(DetectContacts, TellsContactsFifteenMillisecondsApart) {
  const std::vector<Burst> bursts{{0.1, 0.8}, {0.115, 0.5}, {0.13, 0.6}, {0.145, 0.3}, {0.3, 0.4}};
  const auto contacts = detectContacts(test::burstsInNoise(bursts, 0.6, 44100, 1e-4));
  ASSERT_TRUE(contacts);
  const auto score = test::scoreDetection(timesOf(bursts), startsOf(*contacts), 0.001);
  EXPECT_EQ(score.missed + score.invented, 0U);
  EXPECT_EQ(contacts->back().end, contacts->back().start);
}

TEST(DetectContacts, ClippingMovesNothing) {
  auto sound = test::burstsInNoise(bounces(), 1.5, 44100, 1e-4);
  for (float& sample : sound.samples) sample = std::clamp(4 * sample, -1.0F, 1.0F);
  const auto contacts = detectContacts(sound);
  ASSERT_TRUE(contacts);
  const auto score = test::scoreDetection(timesOf(bounces()), startsOf(*contacts), 0.002);
  EXPECT_EQ(score.missed + score.invented, 0U);
}

TEST(DetectContacts, HearsSoftContactsInTheRingOfALoudOne) {
  std::vector<Burst> bursts{{0.1, 0.5, 0.003}, {0.25, 0.08, 0.003}, {0.4, 0.08, 0.003}};
  auto sound = test::burstsInNoise(bursts, 0.7, 44100, 1e-4);
  for (std::size_t i = 4410; i < sound.samples.size(); ++i) {
    const double age = static_cast<double>(i - 4410) / 44100;
    sound.samples[i] +=
        static_cast<float>(0.05 * std::exp(-age / 0.5) * std::sin(6.2832 * 2700 * age));
  }
  const auto contacts = detectContacts(sound);
  ASSERT_TRUE(contacts);
  const auto score = test::scoreDetection(timesOf(bursts), startsOf(*contacts), 0.002);
  EXPECT_EQ(score.missed + score.invented, 0U);
}

TEST(DetectContacts, IsSurerOfWhatRisesMore) {
  DetectorSettings settings;
  settings.minRise = 3;
  const auto contacts = detectContacts(test::burstsInNoise(bounces(), 1.5, 44100, 0.01), settings);
  ASSERT_TRUE(contacts);
  for (const DetectedContact& a : *contacts) {
    EXPECT_GT(a.confidence, 0);
    EXPECT_LE(a.confidence, 1);
    EXPECT_EQ(a.confidence > 0.5, a.rise > 4.5);
    for (const DetectedContact& b : *contacts) {
      EXPECT_TRUE(a.rise <= b.rise || a.confidence >= b.confidence);
    }
  }
  EXPECT_GT(contacts->front().confidence, 0.999);
}

TEST(DetectContacts, NothingIsFoundWhereNothingHappens) {
  const auto noise = detectContacts(test::burstsInNoise({}, 2, 44100, 0.1));
  ASSERT_FALSE(noise);
  EXPECT_EQ(noise.error().code, ErrorCode::kBadInput);
  EXPECT_FALSE(noise.error().remedy.empty());
  EXPECT_FALSE(detectContacts(test::silence(1, 44100)));
  EXPECT_FALSE(detectContacts(test::silence(0, 44100)));
}

TEST(DetectContacts, ALongSoundTakesAboutASecond) {
  std::vector<Burst> bursts;
  for (int i = 0; i < 200; ++i) bursts.push_back({0.1 + 0.29 * i, 0.5, 0.005});
  const auto sound = test::burstsInNoise(bursts, 60, 44100, 1e-4);
  const auto start = std::chrono::steady_clock::now();
  const auto contacts = detectContacts(sound);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(contacts);
  EXPECT_EQ(contacts->size(), 200U);
  // Measured: 0.14 s. The bound leaves room for sanitizers and busy machines.
  EXPECT_LT(taken.count(), 20.0);
  RecordProperty("seconds", std::to_string(taken.count()));
}

}  // namespace
}  // namespace ifa
