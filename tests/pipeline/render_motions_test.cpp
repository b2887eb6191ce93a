// SPDX-License-Identifier: Apache-2.0
// Films, sheets, stills and sequences of motions on disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "ifa/film.h"
#include "support/motion_folder.h"
#include "support/pixels.h"
#include "support/read_png.h"
#include "support/temporary_folder.h"
#ifdef IFA_WITH_FILM
#include "film/read_film.h"
#endif

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class RenderMotions : public testing::Test {
 protected:
  void SetUp() override {
    test::writeMotionFolder(folder_ / "one", motion_);
    options_.width = options_.height = 64;
    options_.framesPerSecond = 8;
    options_.camera = CameraKind::kFixed;
  }
  /// The names in the test's folder, without those of the motion itself.
  std::vector<std::string> outputs() const { return test::namesBeside(folder_.path(), "one"); }
  std::vector<std::string> warnings(const std::string& output) {
    const auto told = renderMotions({folder_ / "one"}, folder_ / output, options_);
    EXPECT_TRUE(told) << told.error().text();
    return told ? *told : std::vector<std::string>{};
  }
  /// What it fails with.
  Error failure(const std::string& output, std::optional<double> still = {},
                const Progress& progress = {}) {
    const auto told = renderMotions({folder_ / "one"}, folder_ / output, options_, still, progress);
    EXPECT_FALSE(told) << output;
    return told ? Error{} : told.error();
  }
  /// Half a second of rest at the end, or the sound's end where that is later.
  std::size_t frames() const {
    const double end = motion_.trajectory.back().time + motion_.sound.firstContact + 0.5;
    return static_cast<std::size_t>(
        std::ceil(end / options_.speed * options_.framesPerSecond - 1e-9));
  }

  test::TemporaryFolder folder_;
  const Motion motion_ = test::makeDieMotion();
  FilmOptions options_;
};

#ifdef IFA_WITH_FILM
TEST_F(RenderMotions, WritesAFilmWithItsSound) {
  EXPECT_THAT(warnings("film.mp4"), IsEmpty());
  EXPECT_THAT(outputs(), ElementsAre("film.mp4"));
  const auto film = test::readFilm(folder_ / "film.mp4");
  EXPECT_EQ(film.width, 64);
  EXPECT_EQ(film.height, 64);
  EXPECT_EQ(film.frames.size(), frames());
  EXPECT_THAT(film.soundCodec, Not(IsEmpty()));
}

TEST_F(RenderMotions, SlowMotionHasMorePictures) {
  options_.speed = 0.5;
  EXPECT_THAT(warnings("film.mp4"), IsEmpty());
  EXPECT_EQ(test::readFilm(folder_ / "film.mp4").frames.size(), frames());
}

TEST_F(RenderMotions, ASoundOfAnHourDoesNotMakeAFilmOfAnHour) {
  Motion motion = motion_;
  fs::remove_all(folder_ / "one");
  test::writeMotionFolder(folder_ / "one", motion, 30);
  EXPECT_THAT(warnings("film.mp4"), IsEmpty());
  const double end = motion.trajectory.back().time + motion.sound.firstContact + 2;
  EXPECT_EQ(test::readFilm(folder_ / "film.mp4").frames.size(),
            static_cast<std::size_t>(std::ceil(end * 8 - 1e-9)));
}

TEST_F(RenderMotions, AMissingSoundMakesASilentFilmAndAWarning) {
  fs::remove(folder_ / "one/sound.wav");
  EXPECT_THAT(warnings("film.mp4"), ElementsAre(HasSubstr("sound.wav")));
  const auto film = test::readFilm(folder_ / "film.mp4");
  EXPECT_THAT(film.soundCodec, IsEmpty());
  EXPECT_EQ(film.frames.size(), frames());
}

TEST_F(RenderMotions, AMotionOfASignatureHasNoSound) {
  Motion motion = motion_;
  motion.sound.file.clear();
  ASSERT_TRUE(writeMotionJson(folder_ / "one/motion.json", motion));
  EXPECT_THAT(warnings("film.mp4"), ElementsAre(HasSubstr("silent")));
  EXPECT_THAT(test::readFilm(folder_ / "film.mp4").soundCodec, IsEmpty());
}

TEST_F(RenderMotions, MuteLeavesTheSoundOut) {
  options_.mute = true;
  EXPECT_THAT(warnings("film.mp4"), IsEmpty());
  EXPECT_THAT(test::readFilm(folder_ / "film.mp4").soundCodec, IsEmpty());
}

TEST_F(RenderMotions, AnInterruptedFilmLeavesNothing) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  EXPECT_EQ(failure("film.mp4", {}, progress).code, ErrorCode::kInterrupted);
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(RenderMotions, AnInterruptedFilmLeavesTheOldOne) {
  test::writeText(folder_ / "film.mp4", "old");
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  double share = 0;
  progress.report = [&](std::string_view, double value) {
    share = value;
    stop = value > 0.3;
  };
  EXPECT_EQ(failure("film.mp4", {}, progress).code, ErrorCode::kInterrupted);
  EXPECT_LT(share, 0.7) << "it ends soon";
  EXPECT_EQ(test::readText(folder_ / "film.mp4"), "old");
}

TEST_F(RenderMotions, ReportsHowFarItIs) {
  std::vector<double> shares;
  Progress progress;
  progress.report = [&](std::string_view stage, double share) {
    EXPECT_EQ(stage, "film");
    shares.push_back(share);
  };
  ASSERT_TRUE(renderMotions({folder_ / "one"}, folder_ / "film.mp4", options_, {}, progress));
  EXPECT_EQ(shares.size(), frames());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}
#endif

TEST_F(RenderMotions, WritesASequenceWithItsSound) {
  EXPECT_THAT(warnings("pictures"), IsEmpty());
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_ / "pictures")) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_EQ(names.size(), frames() + 1);
  EXPECT_THAT(names, Contains("frame-00001.png"));
  EXPECT_THAT(names, Contains(fmt::format("frame-{:05}.png", frames())));
  EXPECT_THAT(names, Contains("sound.wav"));
  // From the throw to rest the picture changes, and then no more.
  const auto frame = [&](std::size_t number) {
    return test::readPng(folder_ / "pictures" / fmt::format("frame-{:05}.png", number));
  };
  EXPECT_EQ(frame(1).width, 64);
  EXPECT_NE(frame(2).rgb, frame(4).rgb);
  EXPECT_EQ(frame(frames()).rgb, frame(frames() - 2).rgb);
}

TEST_F(RenderMotions, AShorterSequenceReplacesALongerOne) {
  EXPECT_THAT(warnings("pictures"), IsEmpty());
  test::writeText(folder_ / "pictures/notes.txt", "mine");
  options_.framesPerSecond = 4;
  options_.mute = true;
  EXPECT_THAT(warnings("pictures"), IsEmpty());
  std::size_t pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "pictures")) {
    pictures += entry.path().extension() == ".png";
  }
  EXPECT_EQ(pictures, frames());
  EXPECT_FALSE(fs::exists(folder_ / "pictures/sound.wav")) << "that was the other's";
  EXPECT_EQ(test::readText(folder_ / "pictures/notes.txt"), "mine");
}

TEST_F(RenderMotions, ASequenceDoesNotTakeTheMotionsOwnSound) {
  const std::string sound = test::readText(folder_ / "one/sound.wav");
  options_.mute = true;
  const Error error = failure("one");
  EXPECT_EQ(error.code, ErrorCode::kUsage);
  EXPECT_THAT(error.text(), HasSubstr("sound"));
  EXPECT_TRUE(test::readText(folder_ / "one/sound.wav") == sound);
}

TEST_F(RenderMotions, AnInterruptedSequenceLeavesNothing) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  EXPECT_EQ(failure("pictures", {}, progress).code, ErrorCode::kInterrupted);
  EXPECT_EQ(failure("sheet.png", {}, progress).code, ErrorCode::kInterrupted);
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(RenderMotions, WritesASheetOfItsContacts) {
  EXPECT_THAT(warnings("sheet.png"), IsEmpty());
  EXPECT_THAT(outputs(), ElementsAre("sheet.png"));
  const Image sheet = test::readPng(folder_ / "sheet.png");
  // Three contacts: two columns and two rows.
  EXPECT_GT(sheet.width, 2 * 64);
  EXPECT_LT(sheet.width, 3 * 64);
  EXPECT_GT(sheet.height, 2 * 64);
}

TEST_F(RenderMotions, WritesAStillAtATimeOfTheSound) {
  const double time = 0.3;
  ASSERT_TRUE(renderMotions({folder_ / "one"}, folder_ / "still.png", options_, time));
  ASSERT_TRUE(
      renderMotions({folder_ / "one/motion.json"}, folder_ / "later.png", options_, time + 1));
  EXPECT_THAT(outputs(), ElementsAre("later.png", "still.png"));
  const Image still = test::readPng(folder_ / "still.png");
  EXPECT_EQ(still.width, 64);
  EXPECT_NE(still.rgb, test::readPng(folder_ / "later.png").rgb);
  // The sequence has the same picture at that time.
  options_.framesPerSecond = 10;
  ASSERT_TRUE(renderMotions({folder_ / "one"}, folder_ / "still2.png", options_, time));
  EXPECT_THAT(warnings("pictures"), IsEmpty());
  EXPECT_EQ(test::readPng(folder_ / "pictures/frame-00004.png").rgb,
            test::readPng(folder_ / "still2.png").rgb);
}

TEST_F(RenderMotions, SideBySideEachHasAViewOfItsOwn) {
  Motion second = motion_;
  for (auto& sample : second.trajectory) sample.position.x() += 0.1 * sample.time;
  test::writeMotionFolder(folder_ / "two", second);
  ASSERT_TRUE(renderMotions({folder_ / "one"}, folder_ / "alone.png", options_, 0.5));
  options_.sideBySide = true;
  options_.width = 128;
  ASSERT_TRUE(
      renderMotions({folder_ / "one", folder_ / "two"}, folder_ / "both.png", options_, 0.5));
  const Image alone = test::readPng(folder_ / "alone.png"),
              both = test::readPng(folder_ / "both.png");
  ASSERT_EQ(both.width, 128);
  int differing = 0;
  // Below the names and left of the line between the pictures.
  for (int y = 24; y < 64; ++y) {
    for (int x = 0; x < 63; ++x) {
      differing += test::pixelAt(both, x, y) != test::pixelAt(alone, x, y);
    }
  }
  EXPECT_EQ(differing, 0);
  int named = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 63; ++x) named += test::pixelAt(both, x, y) != test::pixelAt(alone, x, y);
  }
  EXPECT_GT(named, 10) << "its name is written on it";
}

TEST_F(RenderMotions, BodiesShareOneFloorUnlessToldOtherwise) {
  Motion second = motion_;
  for (auto& sample : second.trajectory) sample.position.y() += 0.08;
  for (auto& contact : second.contacts) contact.position.y() += 0.08;
  test::writeMotionFolder(folder_ / "two", second);
  ASSERT_TRUE(renderMotions({folder_ / "one", folder_ / "two"}, folder_ / "both.png", options_, 3));
  ASSERT_TRUE(renderMotions({folder_ / "one"}, folder_ / "alone.png", options_, 3));
  EXPECT_NE(test::readPng(folder_ / "both.png").rgb, test::readPng(folder_ / "alone.png").rgb);
  EXPECT_EQ(test::readPng(folder_ / "both.png").width, 64);
}

TEST_F(RenderMotions, OverlayIsDrawnAtTheLowerEdge) {
  options_.width = 128, options_.height = 256;
  options_.overlay = true;
  ASSERT_TRUE(renderMotions({folder_ / "one"}, folder_ / "with.png", options_, 0.3));
  const Image image = test::readPng(folder_ / "with.png");
  // Dark glass over the floor, left of the text and of the playhead's glow.
  EXPECT_LT(test::meanBrightness(image, 0, 248, 10, 256),
            0.8 * test::meanBrightness(image, 0, 205, 10, 213));
}

TEST_F(RenderMotions, OptionsOutOfRangeAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const FilmOptions good = options_;
  const auto refused = [&](const char* place, const auto& change) {
    options_ = good;
    change(options_);
    const Error error = failure("film.mp4");
    EXPECT_EQ(error.code, ErrorCode::kUsage) << place;
    EXPECT_THAT(error.place, HasSubstr(place));
    EXPECT_THAT(error.remedy, Not(IsEmpty()));
  };
  refused("size", [](FilmOptions& o) { o.width = 65; });
  refused("size", [](FilmOptions& o) { o.width = 62; });
  refused("size", [](FilmOptions& o) { o.height = 4098; });
  refused("size", [](FilmOptions& o) { o.height = 0; });
  refused("size", [](FilmOptions& o) { o.height = -64; });
  refused("frames", [](FilmOptions& o) { o.framesPerSecond = 0.5; });
  refused("frames", [](FilmOptions& o) { o.framesPerSecond = 241; });
  refused("frames", [&](FilmOptions& o) { o.framesPerSecond = nan; });
  refused("shutter", [](FilmOptions& o) { o.shutter = 1.01; });
  refused("shutter", [&](FilmOptions& o) { o.shutter = nan; });
  refused("speed", [](FilmOptions& o) { o.speed = 0; });
  refused("speed", [](FilmOptions& o) { o.speed = std::numeric_limits<double>::infinity(); });
  refused("floor", [](FilmOptions& o) { o.floor = "lava"; });
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(RenderMotions, CallsThatMakeNoSenseAreRefused) {
  EXPECT_EQ(failure("film.avi").code, ErrorCode::kUsage);
  EXPECT_EQ(failure("film.mp4", 0.5).code, ErrorCode::kUsage);
  EXPECT_EQ(failure("pictures", 0.5).code, ErrorCode::kUsage);
  EXPECT_EQ(failure("still.png", std::numeric_limits<double>::quiet_NaN()).code, ErrorCode::kUsage);
  const auto none = renderMotions({}, folder_ / "film.mp4", options_);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kUsage);
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(RenderMotions, WhatCannotBeReadOrWrittenIsNamed) {
  const auto refused = [&](const fs::path& motion, const fs::path& output,
                           const std::string& place) {
    const auto told = renderMotions({motion}, output, options_);
    ASSERT_FALSE(told) << place;
    EXPECT_EQ(told.error().code, ErrorCode::kBadInput) << told.error().text();
    EXPECT_THAT(told.error().text(), HasSubstr(place));
  };
  refused(folder_ / "nobody", folder_ / "sheet.png", "nobody");
  for (const char* name : {"film.mp4", "sheet.png"}) {
    refused(folder_ / "one", folder_ / "missing" / name, "missing");
  }
  test::writeText(folder_ / "file", "x");
  refused(folder_ / "one", folder_ / "file", "file");
  refused(folder_ / "one", folder_ / "file/pictures", "file");
  fs::remove(folder_ / "file");
  test::writeText(folder_ / "one/motion.json", "{");
  refused(folder_ / "one", folder_ / "sheet.png", "motion.json");
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(RenderMotions, AMotionWithoutContactsHasNoSheet) {
  Motion motion = motion_;
  motion.contacts.clear();
  ASSERT_TRUE(writeMotionJson(folder_ / "one/motion.json", motion));
  EXPECT_EQ(failure("sheet.png").code, ErrorCode::kBadInput);
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(RenderMotions, AMissingObjectIsTakenFromTheLibraryWithAWarning) {
  for (const char* name : {"d6.json", "d6.obj", "d6.mtl"}) fs::remove(folder_ / "one" / name);
  EXPECT_THAT(warnings("sheet.png"), ElementsAre(HasSubstr("d6.json")));
}

}  // namespace
}  // namespace ifa
