// SPDX-License-Identifier: Apache-2.0
#include "sound/envelope.h"

#include <gtest/gtest.h>

#include "sound/synthetic_sound.h"

namespace ifa {
namespace {

TEST(Envelope, IsTheLargestSampleOfEachMillisecond) {
  Sound sound = test::silence(0.01, 44100);  // 44.1 samples a bin: bins of 44 and 45
  sound.samples[0] = 0.1F;
  sound.samples[44] = -0.5F;   // 0.998 ms, the last of the first bin
  sound.samples[45] = 0.3F;    // 1.020 ms
  sound.samples[440] = -0.9F;  // 9.977 ms
  const auto bins = envelope(sound);
  ASSERT_EQ(bins.size(), 10U);
  EXPECT_EQ(bins[0], 0.5F);
  EXPECT_EQ(bins[1], 0.3F);
  for (std::size_t k = 2; k < 9; ++k) EXPECT_EQ(bins[k], 0.0F);
  EXPECT_EQ(bins[9], 0.9F);
}

TEST(Envelope, EverySampleIsInOneBin) {
  for (const int rate : {1000, 11025, 48000, 88200, 999983}) {
    Sound sound = test::silence(0.02, rate);
    for (std::size_t i = 0; i < sound.samples.size(); i += 1 + sound.samples.size() / 200) {
      sound.samples.assign(sound.samples.size(), 0.0F);
      sound.samples[i] = 1.0F;
      const auto bins = envelope(sound);
      float sum = 0;
      for (const float bin : bins) sum += bin;
      ASSERT_EQ(sum, 1.0F) << rate << " Hz, sample " << i;
    }
  }
}

TEST(Envelope, BinsCountFromTheStartOfTheInterval) {
  Sound sound = test::silence(0.1, 1000);
  sound.samples[50] = 1.0F;
  const auto bins = envelope(sound, 0.048, 0.0525);
  ASSERT_EQ(bins.size(), 5U);  // the last is half a bin
  EXPECT_EQ(bins[2], 1.0F);
  EXPECT_TRUE(envelope(sound, 0.2, 0.1).empty());
  EXPECT_EQ(envelope(sound, 0.099, 0.102), (std::vector<float>{0, 0, 0}));
}

TEST(PeakAmplitude, LooksInsideTheIntervalOnly) {
  Sound sound = test::silence(0.1, 48000);
  sound.samples[1000] = -0.7F;
  EXPECT_EQ(peakAmplitude(sound, 0.02, 0.03), 0.7F);
  EXPECT_EQ(peakAmplitude(sound, 0.0, 0.0208), 0.0F);
  EXPECT_EQ(peakAmplitude(sound, 1000.0 / 48000, 1000.0 / 48000), 0.7F);
  EXPECT_EQ(peakAmplitude(sound, 0.2, 0.3), 0.0F);
}

}  // namespace
}  // namespace ifa
