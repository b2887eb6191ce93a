// SPDX-License-Identifier: Apache-2.0
// What the writer refuses.
#include "film/film_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "film_scenes.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::movingPicture;
using test::smallSettings;
using testing::HasSubstr;
using testing::IsEmpty;

struct BadSetting {
  const char* field;
  std::function<void(FilmSettings&)> spoil;
};

class BadSettings : public testing::TestWithParam<BadSetting> {};

TEST_P(BadSettings, AreNamed) {
  const test::TemporaryFolder folder;
  FilmSettings settings = smallSettings();
  GetParam().spoil(settings);
  const auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().code, ErrorCode::kUsage);
  EXPECT_EQ(writer.error().place, GetParam().field);
  EXPECT_NE(writer.error().remedy, "");
  EXPECT_THAT(folder.names(), IsEmpty());
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Each, BadSettings,
    testing::Values(BadSetting{"width", [](auto& s) { s.width = 65; }},
                    BadSetting{"width", [](auto& s) { s.width = 14; }},
                    BadSetting{"width", [](auto& s) { s.width = -64; }},
                    BadSetting{"width", [](auto& s) { s.width = 8194; }},
                    BadSetting{"height", [](auto& s) { s.height = 47; }},
                    BadSetting{"height", [](auto& s) { s.height = 0; }},
                    BadSetting{"framesPerSecond", [](auto& s) { s.framesPerSecond = 0.5; }},
                    BadSetting{"framesPerSecond", [](auto& s) { s.framesPerSecond = 241; }},
                    BadSetting{"framesPerSecond", [](auto& s) { s.framesPerSecond = kNan; }},
                    BadSetting{"framesPerSecond", [](auto& s) { s.framesPerSecond = kInfinite; }},
                    BadSetting{"quality", [](auto& s) { s.quality = -1; }},
                    BadSetting{"quality", [](auto& s) { s.quality = 52; }},
                    BadSetting{"quality", [](auto& s) { s.quality = kNan; }},
                    BadSetting{"speed", [](auto& s) { s.speed = 0; }},
                    BadSetting{"speed", [](auto& s) { s.speed = -1; }},
                    BadSetting{"speed", [](auto& s) { s.speed = 1e9; }},
                    BadSetting{"speed", [](auto& s) { s.speed = kNan; }}),
    [](const auto& test) { return test.param.field + std::to_string(test.index); });

TEST(FilmWriter, FilmsCanBeWritten) { EXPECT_TRUE(filmsCanBeWritten()); }

TEST(FilmWriter, RefusesASoundWithoutSamples) {
  const test::TemporaryFolder folder;
  Sound sound;
  sound.rate = 48000;
  const auto empty = FilmWriter::open(folder / "film.mp4", smallSettings(), &sound);
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::kUsage);
  EXPECT_EQ(empty.error().place, "sound");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(FilmWriter, SaysWhatToInstallWhenThereIsNoEncoder) {
  const test::TemporaryFolder folder;
  FilmSettings settings = smallSettings();
  // None; one of sound; one that takes no 4:2:0; one that MP4 does not hold.
  for (const auto& encoders :
       std::vector<std::vector<std::string>>{{}, {"no-such-encoder"}, {"aac"}, {"gif"}, {"flv"}}) {
    settings.encoders = encoders;
    const auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().code, ErrorCode::kInternal);
    EXPECT_THAT(writer.error().remedy, HasSubstr("libx264"));
    for (const std::string& name : encoders) EXPECT_THAT(writer.error().message, HasSubstr(name));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(FilmWriter, RefusesAFrameOfAnotherSize) {
  const test::TemporaryFolder folder;
  const FilmSettings settings = smallSettings();
  Image torn = movingPicture(settings, 0);
  torn.rgb.pop_back();
  for (const Image& wrong : {Image(66, 48), Image(64, 46), Image(), torn}) {
    auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
    ASSERT_TRUE(writer && writer->add(movingPicture(settings, 0)));
    const auto added = writer->add(wrong);
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::kInternal);
    EXPECT_EQ(added.error().place, "frame 1");
    // From then on everything fails alike, and nothing is left.
    EXPECT_EQ(writer->add(movingPicture(settings, 1)).error().text(), added.error().text());
    EXPECT_EQ(writer->finish().error().text(), added.error().text());
    EXPECT_THAT(folder.names(), IsEmpty());
  }
}

TEST(FilmWriter, RefusesAFilmWithoutFrames) {
  const test::TemporaryFolder folder;
  auto writer = FilmWriter::open(folder / "film.mp4", smallSettings(), nullptr);
  ASSERT_TRUE(writer);
  const auto finished = writer->finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().code, ErrorCode::kInternal);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(FilmWriter, TakesNothingOnceItIsFinished) {
  const test::TemporaryFolder folder;
  const FilmSettings settings = smallSettings();
  auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
  ASSERT_TRUE(writer && writer->add(movingPicture(settings, 0)) && writer->finish());
  EXPECT_FALSE(writer->add(movingPicture(settings, 1)));
  EXPECT_FALSE(writer->finish());
  EXPECT_THAT(folder.names(), testing::ElementsAre("film.mp4"));
}

// Not a number in the sound is refused by libav, whose words come with the error.
TEST(FilmWriter, TellsWhatLibavSays) {
  const test::TemporaryFolder folder;
  const FilmSettings settings = smallSettings(10);
  Sound sound;
  sound.rate = 48000;
  sound.samples.assign(48000, std::numeric_limits<float>::quiet_NaN());
  auto writer = FilmWriter::open(folder / "film.mp4", settings, &sound);
  ASSERT_TRUE(writer);
  const auto added = writer->add(movingPicture(settings, 0));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::kInternal);
  EXPECT_THAT(added.error().message, HasSubstr("NaN"));
}

}  // namespace
}  // namespace ifa
