// SPDX-License-Identifier: Apache-2.0
#include "sound/steady_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sound/synthetic_sound.h"

namespace ifa {
namespace {

const NoiseSettings kDefaults{0.002, 0.008, 1e-12, 1.0 / 3};

class UnlikelyAsNoise : public testing::TestWithParam<int> {};

TEST_P(UnlikelyAsNoise, BoundsHowOftenNoiseRises) {
  std::size_t moments = 0, over3 = 0, over5 = 0, over14 = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto energies = bandEnergies(test::burstsInNoise({}, 30, GetParam(), 0.1, seed));
    for (const double value : unlikelyAsNoise(energies, kDefaults)) {
      ++moments;
      over3 += value > 3 ? 1 : 0;
      over5 += value > 5 ? 1 : 0;
      over14 += value > 14 ? 1 : 0;
    }
  }
  const auto all = static_cast<double>(moments);
  EXPECT_LT(static_cast<double>(over3), std::exp(-3) * all);
  EXPECT_LT(static_cast<double>(over5), std::exp(-5) * all);
  EXPECT_EQ(over14, 0U);
}

INSTANTIATE_TEST_SUITE_P(Rates, UnlikelyAsNoise, testing::Values(16000, 44100, 96000));

TEST(UnlikelyAsNoise, DoesNotDependOnTheVolume) {
  auto sound = test::burstsInNoise({{0.5, 0.2}}, 1, 44100, 0.1);
  const auto loud = unlikelyAsNoise(bandEnergies(sound), kDefaults);
  for (float& sample : sound.samples) sample *= 0.125F;
  const auto soft = unlikelyAsNoise(bandEnergies(sound), kDefaults);
  ASSERT_EQ(loud.size(), soft.size());
  for (std::size_t k = 0; k < loud.size(); ++k) EXPECT_NEAR(loud[k], soft[k], 1e-6) << k;
}

TEST(UnlikelyAsNoise, WhatIsAsLoudAsTheNoiseIsUnlikely) {
  const auto energies = bandEnergies(test::burstsInNoise({{0.5, 0.15}}, 1, 44100, 0.1));
  const auto unlikely = unlikelyAsNoise(energies, kDefaults);
  const auto top = std::max_element(unlikely.begin(), unlikely.end());
  EXPECT_NEAR(static_cast<double>(top - unlikely.begin()) * energies.hop, 0.5, 0.002);
  EXPECT_GT(*top, 14);
}

TEST(UnlikelyAsNoise, NoiseThatNobodyHearsSaysNothing) {
  auto settings = kDefaults;
  settings.floor = 1;
  const auto energies = bandEnergies(test::burstsInNoise({{0.5, 0.5}}, 1, 44100, 0.1));
  for (const double value : unlikelyAsNoise(energies, settings)) EXPECT_EQ(value, 0);
  const auto silent = bandEnergies(test::burstsInNoise({{0.5, 0.5}}, 1, 44100, 0));
  for (const double value : unlikelyAsNoise(silent, kDefaults)) EXPECT_EQ(value, 0);
}

TEST(UnlikelyAsNoise, MoreIsAskedWhereSomethingRings) {
  // Two equal hits; the second one comes while a louder noise dies away.
  const auto energies = bandEnergies(
      test::burstsInNoise({{0.3, 0.3}, {0.6, 0.5, 0.05}, {0.64, 0.3}}, 1, 44100, 0.05));
  const auto unlikely = unlikelyAsNoise(energies, kDefaults);
  const auto at = [&](double time) {
    const auto first = unlikely.begin() + std::lround((time - 0.003) / energies.hop);
    return *std::max_element(first, first + std::lround(0.006 / energies.hop));
  };
  EXPECT_GT(at(0.3), 4 * at(0.64));
}

}  // namespace
}  // namespace ifa
