// SPDX-License-Identifier: Apache-2.0
// The sound of a film, decoded: where its clicks are, and how long it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "film_scenes.h"
#include "read_film.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::DecodedFilm;
using test::Fraction;

constexpr double kFilmRate = 48000;

DecodedFilm filmOf(const Sound& sound, int frames, double speed = 1, double framesPerSecond = 60) {
  const test::TemporaryFolder folder;
  FilmSettings settings = test::smallSettings(framesPerSecond);
  settings.width = settings.height = 16;
  settings.speed = speed;
  test::writeFilm(folder / "film.mp4", settings, frames, &sound);
  return test::readFilm(folder / "film.mp4");
}

struct Tape {
  int rate;
  double speed;
};

class FilmSound : public testing::TestWithParam<Tape> {};

TEST_P(FilmSound, ClicksComeBackWhereTheyWere) {
  const auto [rate, speed] = GetParam();
  const int length = static_cast<int>(std::lround(rate * 2 * speed));
  const std::vector<int> clicks = {length / 400, length / 5, length / 2 + 1, length * 19 / 20};
  const DecodedFilm film = filmOf(test::clicksAtSamples(clicks, rate, length), 120, speed);
  EXPECT_EQ(film.soundCodec, "aac");
  EXPECT_EQ(film.soundRate, 48000);
  EXPECT_EQ(film.firstSample, 0);
  ASSERT_EQ(film.sound.size(), 1u);
  for (const int click : clicks) {
    const double expected = click / (rate * speed) * kFilmRate;
    EXPECT_NEAR(test::clickDelay(film.sound[0], expected, kFilmRate, speed), 0, 0.1) << click;
  }
}

INSTANTIATE_TEST_SUITE_P(Tapes, FilmSound,
                         testing::Values(Tape{44100, 1}, Tape{48000, 1}, Tape{22050, 1},
                                         Tape{96000, 1}, Tape{11025, 1}, Tape{37000, 1},
                                         Tape{192000, 1}, Tape{44100, 0.25}, Tape{48000, 0.25},
                                         Tape{44100, 0.3183098861}, Tape{44101, 1.4142135624},
                                         Tape{48000, 2}),
                         [](const auto& test) { return "Tape" + std::to_string(test.index); });

TEST(FilmSound, ASingleSampleComesBackAtItsPlace) {
  for (const int place : {0, 1, 1023, 1024, 5000}) {
    Sound sound;
    sound.rate = 48000;
    sound.samples.resize(24000);
    sound.samples[static_cast<std::size_t>(place)] = 1;
    const std::vector<float> heard = filmOf(sound, 30).sound.at(0);
    const auto loudest = std::max_element(
        heard.begin(), heard.end(), [](float a, float b) { return std::abs(a) < std::abs(b); });
    EXPECT_EQ(loudest - heard.begin(), place);
  }
}

TEST(FilmSound, KeepsTheLevel) {
  Sound sound;
  sound.rate = 44100;
  for (int i = 0; i < 22050; ++i)
    sound.samples.push_back(static_cast<float>(0.5 * std::sin(i * 2 * 3.14159265 * 440 / 44100)));
  const std::vector<float> heard = filmOf(sound, 30).sound.at(0);
  double squares = 0;
  for (std::size_t i = 4800; i < 19200; ++i) squares += static_cast<double>(heard[i]) * heard[i];
  EXPECT_NEAR(std::sqrt(2 * squares / 14400), 0.5, 0.005);
}

TEST(FilmSound, StereoStaysStereo) {
  const Sound left = test::clicksAtSamples({8000}, 44100, 44100);
  const Sound right = test::clicksAtSamples({30000}, 44100, 44100);
  Sound sound = left;
  sound.channels = 2;
  for (std::size_t i = 0; i < left.samples.size(); ++i) {
    sound.interleaved.push_back(left.samples[i]);
    sound.interleaved.push_back(right.samples[i]);
  }
  const DecodedFilm film = filmOf(sound, 60);
  ASSERT_EQ(film.sound.size(), 2u);
  EXPECT_NEAR(test::clickDelay(film.sound[0], 8000 * 48000.0 / 44100, kFilmRate), 0, 0.1);
  EXPECT_NEAR(test::clickDelay(film.sound[1], 30000 * 48000.0 / 44100, kFilmRate), 0, 0.1);
  EXPECT_LT(std::abs(film.sound[1][8707]), 0.05);
}

TEST(FilmSound, MoreThanTwoChannelsAreHeardAsOne) {
  Sound sound = test::clicksAtSamples({8000}, 48000, 24000);
  sound.channels = 3;
  sound.interleaved.assign(sound.samples.size() * 3, 0.0F);
  const DecodedFilm film = filmOf(sound, 30);
  ASSERT_EQ(film.sound.size(), 1u);
  EXPECT_NEAR(test::clickDelay(film.sound[0], 8000, kFilmRate), 0, 0.1);
}

TEST(FilmSound, IsAsLongAsTheFilm) {
  for (const double seconds : {0.0001, 0.3, 5.0}) {
    const int length = std::max(1, static_cast<int>(seconds * 44100));
    Sound sound;
    sound.rate = 44100;
    sound.samples.assign(static_cast<std::size_t>(length), 0.25F);
    const DecodedFilm film = filmOf(sound, 61);
    EXPECT_EQ(film.soundDuration, (Fraction{61 * 800, 48000})) << seconds;
    EXPECT_EQ(film.videoDuration, (Fraction{61, 60})) << seconds;
    EXPECT_NEAR(film.duration, 61 / 60.0, 1e-6) << seconds;
    // libav's reader, unlike others, plays the last block of 1024 to its end.
    ASSERT_GE(film.sound.at(0).size(), 61u * 800) << seconds;
    EXPECT_LT(film.sound[0].size(), 61u * 800 + 1024) << seconds;
    const bool longer = seconds > 2;
    EXPECT_NEAR(film.sound[0][40000], longer ? 0.25 : 0, 0.02) << seconds;
  }
}

// A frame is 200 samples, a block of AAC 1024: ends within the first block, around its end, at one.
TEST(FilmSound, EndsAnywhereInABlock) {
  const Sound sound = test::clicksAtSamples({100}, 48000, 4800);
  for (const int frames : {1, 2, 5, 6, 10, 11, 127, 128, 129}) {
    const DecodedFilm film = filmOf(sound, frames, 1, 240);
    EXPECT_EQ(film.frames.size(), static_cast<std::size_t>(frames));
    EXPECT_EQ(film.firstSample, 0);
    EXPECT_EQ(film.soundDuration, (Fraction{frames * 200, 48000})) << frames;
    EXPECT_EQ(film.videoDuration, (Fraction{frames, 240})) << frames;
    EXPECT_NEAR(film.duration, frames / 240.0, 1e-6) << frames;
    EXPECT_NEAR(test::clickDelay(film.sound.at(0), 100, kFilmRate), 0, 0.1) << frames;
  }
}

// 1001/30000 s are 1601.6 samples.
TEST(FilmSound, FitsRatesThatDoNotDivideItsOwn) {
  const DecodedFilm film = filmOf(test::clicksAtSamples({24000}, 48000, 60000), 31, 1, 29.97);
  const double samples = 48000.0 * static_cast<double>(film.soundDuration.numerator) /
                         static_cast<double>(film.soundDuration.denominator);
  EXPECT_NEAR(samples, 31 * 1601.6, 1);
  EXPECT_EQ(film.videoDuration, (Fraction{31 * 1001, 30000}));
  EXPECT_NEAR(film.duration, 31 * 1001 / 30000.0, 1e-6);
  EXPECT_NEAR(test::clickDelay(film.sound.at(0), 24000, kFilmRate), 0, 0.1);
}

}  // namespace
}  // namespace ifa
