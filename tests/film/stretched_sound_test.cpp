// SPDX-License-Identifier: Apache-2.0
#include "film/stretched_sound.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "film_scenes.h"

namespace ifa {
namespace {

std::vector<float> readAll(StretchedSound& sound, std::size_t count, std::size_t block) {
  std::vector<float> all(count);
  for (std::size_t at = 0; at < count; at += block) {
    float* plane = all.data() + at;
    test::require(sound.read(&plane, std::min(block, count - at)));
  }
  return all;
}

// A thousandth of a second in an hour is 0.8 samples in a minute.
TEST(StretchedSound, DoesNotDrift) {
  constexpr double kSpeed = 0.9090909123;
  constexpr int kRate = 11027, kClick = 11027 * 50;
  const Sound sound = test::clicksAtSamples({kClick}, kRate, kClick + kRate);
  auto stretched = StretchedSound::open(sound, kSpeed, 48000);
  ASSERT_TRUE(stretched);
  const double expected = kClick / (kRate * kSpeed) * 48000;
  const auto heard = readAll(*stretched, static_cast<std::size_t>(expected) + 5000, 1024);
  EXPECT_NEAR(test::clickDelay(heard, expected, 48000, kSpeed), 0, 0.02);
}

TEST(StretchedSound, LeavesASoundOfTheRateAsItIs) {
  const Sound sound = test::clicksAtSamples({5000, 9000}, 48000, 20000);
  auto stretched = StretchedSound::open(sound, 1, 48000);
  ASSERT_TRUE(stretched);
  std::vector<float> expected = sound.samples;
  expected.resize(30000);
  EXPECT_EQ(readAll(*stretched, 30000, 777), expected);
}

TEST(StretchedSound, DoesNotDependOnHowItIsRead) {
  const Sound sound = test::clicksAtSamples({500, 20000}, 44100, 30000);
  auto one = StretchedSound::open(sound, 0.37, 48000),
       other = StretchedSound::open(sound, 0.37, 48000);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(readAll(*one, 90000, 1024), readAll(*other, 90000, 333));
}

TEST(StretchedSound, TakesExtremes) {
  for (const int rate : {1000, 1000000}) {
    for (const double speed : {0.01, 0.0123456789, 99.0123, 100.0}) {
      const Sound sound = test::clicksAtSamples({1}, rate, 3);
      auto stretched = StretchedSound::open(sound, speed, 48000);
      ASSERT_TRUE(stretched) << rate << ' ' << speed;
      EXPECT_EQ(readAll(*stretched, 2000, 1024).size(), 2000u);
    }
  }
}

}  // namespace
}  // namespace ifa
