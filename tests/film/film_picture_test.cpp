// SPDX-License-Identifier: Apache-2.0
// The picture of a film, decoded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "film/libav.h"
#include "film_scenes.h"
#include "read_film.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::DecodedFilm;
using test::Fraction;
using testing::ElementsAre;
using testing::HasSubstr;

DecodedFilm makeAndRead(const FilmSettings& settings, int frames, const Sound* sound = nullptr) {
  const test::TemporaryFolder folder;
  test::writeFilm(folder / "film.mp4", settings, frames, sound);
  return test::readFilm(folder / "film.mp4");
}

TEST(FilmPicture, IsH264OfThatSizeAndRate) {
  FilmSettings settings;
  settings.width = 320;
  settings.height = 180;
  const DecodedFilm film = makeAndRead(settings, 12);
  EXPECT_EQ(film.videoCodec, "h264");
  EXPECT_EQ(film.soundCodec, "");
  EXPECT_EQ(film.width, 320);
  EXPECT_EQ(film.height, 180);
  EXPECT_EQ(film.frameRate, (Fraction{60, 1}));
  EXPECT_EQ(film.frames.size(), 12u);
  EXPECT_EQ(film.videoDuration, (Fraction{12, 60}));
  EXPECT_DOUBLE_EQ(film.duration, 0.2);
}

TEST(FilmPicture, TakesTheSmallestAndOddShapes) {
  FilmSettings settings;
  for (const auto& [width, height] : {std::pair{16, 16}, {18, 1022}, {1022, 18}}) {
    settings.width = width;
    settings.height = height;
    const DecodedFilm film = makeAndRead(settings, 2);
    EXPECT_EQ(film.width, width);
    EXPECT_EQ(film.height, height);
    EXPECT_EQ(film.frames.size(), 2u);
  }
}

TEST(FilmPicture, IsTaggedAsBt709) {
  EXPECT_THAT(makeAndRead(test::smallSettings(), 2).colourTags,
              ElementsAre(AVCOL_PRI_BT709, AVCOL_TRC_BT709, AVCOL_SPC_BT709, AVCOL_RANGE_MPEG));
}

TEST(FilmPicture, ShowsTheColoursThatItWasGiven) {
  using Colour = std::array<std::uint8_t, 3>;
  const std::vector<Colour> patches = {{255, 0, 0},     {0, 255, 0},     {0, 0, 255},
                                       {128, 128, 128}, {255, 255, 255}, {0, 0, 0},
                                       {200, 120, 40},  {30, 60, 90}};
  FilmSettings settings = test::smallSettings();
  settings.width = 32 * static_cast<int>(patches.size());
  Image image(settings.width, settings.height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const std::size_t column = i / 3 % static_cast<std::size_t>(settings.width);
    image.rgb[i] = patches[column / 32][i % 3];
  }
  const test::TemporaryFolder folder;
  auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
  ASSERT_TRUE(writer && writer->add(image) && writer->finish());
  const DecodedFilm film = test::readFilm(folder / "film.mp4");
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto shown = film.frames.at(0).rgbAt(static_cast<int>(i) * 32 + 16, 24);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], patches[i][c], 4) << i << ' ' << c;
  }
}

// Chroma of a 4:2:0 film lies beside the left of two pixels: a slope of colour shows a shift.
TEST(FilmPicture, ChromaLiesWhereItIsSaidToLie) {
  FilmSettings settings = test::smallSettings();
  settings.quality = 0;
  Image image(settings.width, settings.height);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    image.rgb[i] = static_cast<std::uint8_t>(i / 3 % 64 * 4);
  }
  const test::TemporaryFolder folder;
  auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
  ASSERT_TRUE(writer && writer->add(image) && writer->finish());
  const auto frame = test::readFilm(folder / "film.mp4").frames.at(0);
  for (int column = 8; column < 56; column += 2) {
    const auto at = static_cast<std::size_t>(12 * 32 + column / 2);
    const double red = column * 4 / 255.0;
    EXPECT_NEAR(frame.v[at], 128 + 224 * (red - 0.2126 * red) / 1.5748, 1.01) << column;
  }
}

class FilmRate : public testing::TestWithParam<std::pair<double, Fraction>> {};

TEST_P(FilmRate, EachFrameIsShownExactlyInItsTurn) {
  const auto [asked, exact] = GetParam();
  constexpr int kFrames = 15;
  const DecodedFilm film = makeAndRead(test::smallSettings(asked), kFrames);
  EXPECT_EQ(film.frameRate, exact);
  ASSERT_EQ(film.frames.size(), static_cast<std::size_t>(kFrames));
  for (int k = 0; k < kFrames; ++k) {
    const Fraction expected{k * exact.denominator, exact.numerator};
    EXPECT_EQ(film.frames[static_cast<std::size_t>(k)].time, expected) << k;
  }
  EXPECT_EQ(film.videoDuration, (Fraction{kFrames * exact.denominator, exact.numerator}));
  EXPECT_NEAR(film.duration, kFrames / asked, 2e-6 * kFrames / asked + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Rates, FilmRate,
    testing::Values(std::pair(1.0, Fraction{1, 1}), std::pair(12.5, Fraction{25, 2}),
                    std::pair(23.976, Fraction{24000, 1001}), std::pair(24.0, Fraction{24, 1}),
                    std::pair(24000 / 1001.0, Fraction{24000, 1001}),
                    std::pair(25.0, Fraction{25, 1}), std::pair(29.97, Fraction{30000, 1001}),
                    std::pair(50.0, Fraction{50, 1}), std::pair(59.94, Fraction{60000, 1001}),
                    std::pair(100 / 3.0, Fraction{100, 3}), std::pair(60.0, Fraction{60, 1}),
                    std::pair(119.88, Fraction{120000, 1001}), std::pair(144.0, Fraction{144, 1}),
                    std::pair(239.123456, Fraction{19369, 81}), std::pair(240.0, Fraction{240, 1})),
    [](const auto& test) { return "Rate" + std::to_string(test.index); });

TEST(FilmPicture, HasAKeyFrameEverySecond) {
  const DecodedFilm film = makeAndRead(test::smallSettings(9.99), 25);
  for (const std::size_t k : {0u, 10u, 20u}) EXPECT_TRUE(film.frames.at(k).isKey) << k;
}

TEST(FilmPicture, QualityCosts) {
  const test::TemporaryFolder folder;
  FilmSettings settings = test::smallSettings();
  const auto size = [&](double quality) {
    settings.quality = quality;
    test::writeFilm(folder / "film.mp4", settings, 5);
    return std::filesystem::file_size(folder / "film.mp4");
  };
  EXPECT_GT(size(10.5), size(30.5));
}

TEST(FilmPicture, FallsBackToAnotherEncoderAndSaysSo) {
  const test::TemporaryFolder folder;
  for (const double rate : {60.0, 119.88}) {  // more ticks than an MPEG-4 picture's head can tell
    FilmSettings settings = test::smallSettings(rate);
    settings.encoders = {"no-such-encoder", "aac", "mpeg4"};
    const std::string warning = test::writeFilm(folder / "film.mp4", settings, 8);
    EXPECT_THAT(warning, HasSubstr("mpeg4"));
    EXPECT_THAT(warning, HasSubstr("libx264"));
    const DecodedFilm film = test::readFilm(folder / "film.mp4");
    EXPECT_EQ(film.videoCodec, "mpeg4");
    EXPECT_EQ(film.frames.size(), 8u);
    EXPECT_NEAR(film.duration, 8 / rate, 2e-6);
    EXPECT_THAT(film.colourTags,
                ElementsAre(AVCOL_PRI_BT709, AVCOL_TRC_BT709, AVCOL_SPC_BT709, testing::_));
  }
}

TEST(FilmPicture, H264NeedsNoWarning) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::writeFilm(folder / "film.mp4", test::smallSettings(), 1), "");
}

}  // namespace
}  // namespace ifa
