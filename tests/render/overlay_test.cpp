// SPDX-License-Identifier: Apache-2.0
#include "render/overlay.h"

#include <gtest/gtest.h>

#include "scenes.h"
#include "support/pixels.h"

namespace ifa::render {
namespace {

using test::brightness;
using test::pixelAt;

constexpr int kWidth = 320, kHeight = 200;
constexpr int kTop = 174;  // of the strip: 13 % of the height
constexpr double kSeconds = 2;

/// Contacts 0.5 s and 1 s into the sound, the second one a tenth of a second long.
Motion motion() {
  Motion all = test::restAt({0, 0, 0.01});
  all.sound.firstContact = 0.5;
  MotionContact second = all.contacts.front();
  second.time = 0.5;
  second.end = 0.6;
  all.contacts.push_back(second);
  return all;
}
int column(double time) { return static_cast<int>(kWidth * time / kSeconds); }

Image grey() {
  Image image(kWidth, kHeight);
  for (auto& value : image.rgb) value = 100;
  return image;
}

/// @param step  between frames, s of the sound
Image drawn(double time, const Sound& sound = {}, double speed = 1, double step = 0) {
  Image image = grey();
  Overlay(motion(), sound, kSeconds, speed, step, kWidth, kHeight).draw(image, time);
  return image;
}

/// How much more red than blue.
int warmth(const Image& image, int x, int y) {
  const auto p = pixelAt(image, x, y);
  return p[0] - p[2];
}

TEST(Overlay, ChangesItsRowsOnly) {
  const Image before = grey(), after = drawn(0.7);
  for (int y = 0; y < kHeight; ++y) {
    int changed = 0;
    for (int x = 0; x < kWidth; ++x) changed += pixelAt(before, x, y) != pixelAt(after, x, y);
    EXPECT_EQ(changed, y < kTop ? 0 : kWidth) << y;
  }
}

TEST(Overlay, PlayheadStandsAtTheTime) {
  for (const double time : {0.1, 0.3, 0.8, 1.5}) {
    const Image image = drawn(time);
    // In the lower half, left of the text, nothing else is as bright.
    int brightest = 0;
    for (int x = 0; x < 250; ++x) {
      if (brightness(image, x, kHeight - 4) > brightness(image, brightest, kHeight - 4)) {
        brightest = x;
      }
    }
    EXPECT_NEAR(brightest, kWidth * time / kSeconds, 1) << time;
  }
}

TEST(Overlay, PassedContactsDifferFromThoseToCome) {
  for (const double contact : {0.5, 1.0}) {
    const int x = column(contact);
    const Image before = drawn(contact - 0.1), after = drawn(contact + 0.8);
    EXPECT_LT(std::abs(warmth(before, x, kTop + 1)), 10) << "white";
    EXPECT_GT(warmth(after, x, kTop + 1), 40) << "amber";
  }
  // The longer event is underlined for as long as it lasts.
  const Image after = drawn(1.9);
  EXPECT_GT(warmth(after, column(1.05), kTop), 20);
  EXPECT_LT(warmth(after, column(1.15), kTop), 10);
  EXPECT_LT(warmth(after, column(0.55), kTop), 10);
}

TEST(Overlay, AContactFlashesWhenItSounds) {
  const int x = column(0.5) + 2, y = kTop + 5;
  const int before = warmth(drawn(0.45), x, y), at = warmth(drawn(0.5), x, y),
            soon = warmth(drawn(0.55), x, y), later = warmth(drawn(0.8), x, y);
  EXPECT_LT(before, 10);
  EXPECT_GT(at, 60);
  EXPECT_LT(soon, at);
  EXPECT_GT(soon, later);
  EXPECT_LT(later, 10);
  // As long as the event lasts.
  EXPECT_GT(warmth(drawn(1.09), column(1.0) + 2, y), 60);
}

TEST(Overlay, AContactFlashesInTheFrameNearestToIt) {
  const int x = column(0.5) + 2, y = kTop + 5;
  const double step = 0.04;
  EXPECT_LT(warmth(drawn(0.5 - 0.6 * step, {}, 1, step), x, y), 10);
  EXPECT_GT(warmth(drawn(0.5 - 0.4 * step, {}, 1, step), x, y), 60);
}

TEST(Overlay, FlashesAsLongInSlowMotion) {
  const int x = column(0.5) + 2, y = kTop + 5;
  // 50 ms of the sound take 200 ms of a film at a quarter of the speed.
  EXPECT_GT(warmth(drawn(0.55, {}, 1), x, y), 10);
  EXPECT_LT(warmth(drawn(0.55, {}, 0.25), x, y), 10);
}

TEST(Overlay, ShowsTheWaveform) {
  Sound sound;
  sound.rate = 1000;
  sound.samples.resize(2000);
  for (std::size_t i = 800; i < 900; ++i) sound.samples[i] = i % 2 == 0 ? 0.2f : -0.2f;
  const Image image = drawn(1.9, sound), silent = drawn(1.9);
  const int middle = kTop + 15;
  for (const int y : {middle - 8, middle, middle + 8}) {
    EXPECT_GT(brightness(image, column(0.85), y), brightness(silent, column(0.85), y) + 100) << y;
  }
  EXPECT_EQ(pixelAt(image, column(0.3), middle - 4), pixelAt(silent, column(0.3), middle - 4));
  EXPECT_EQ(pixelAt(image, column(0.3), middle + 6), pixelAt(silent, column(0.3), middle + 6));
}

TEST(Overlay, ASoundShorterThanTheStripIsFollowedByNothing) {
  Sound sound;
  sound.rate = 1000;
  sound.samples.assign(500, 0.5f);
  const Image image = drawn(1.9, sound), silent = drawn(1.9);
  EXPECT_NE(pixelAt(image, column(0.25), kTop + 10), pixelAt(silent, column(0.25), kTop + 10));
  EXPECT_EQ(pixelAt(image, column(0.75), kTop + 10), pixelAt(silent, column(0.75), kTop + 10));
}

TEST(Overlay, TellsTheTimeAndTheSpeed) {
  const auto textPixels = [](const Image& image) {
    int count = 0;
    for (int y = kTop; y < kHeight; ++y) {
      for (int x = 200; x < kWidth; ++x) count += brightness(image, x, y) > 450;
    }
    return count;
  };
  EXPECT_GT(textPixels(drawn(0.1)), 20);
  EXPECT_GT(textPixels(drawn(0.1, {}, 0.25)), textPixels(drawn(0.1)) + 10);
}

TEST(Overlay, TakesSmallPictures) {
  for (const int side : {16, 64}) {
    Image image(side, side);
    const Overlay strip(motion(), {}, kSeconds, 1, 1.0 / 60, side, side);
    strip.draw(image, 1);
    EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(3 * side * side));
  }
}

}  // namespace
}  // namespace ifa::render
