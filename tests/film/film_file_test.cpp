// SPDX-License-Identifier: Apache-2.0
// A film as a file: what is left of it when it succeeds and when it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <limits>

#include "film_scenes.h"
#include "read_film.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using test::smallSettings;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// While one lives, no file of this process grows beyond `bytes`: a disk that is full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

// Cannot be compressed: a film of it soon fills any buffer.
Image noise(const FilmSettings& settings, unsigned seed) {
  Image image(settings.width, settings.height);
  for (std::uint8_t& value : image.rgb) {
    seed = seed * 1664525 + 1013904223;
    value = static_cast<std::uint8_t>(seed >> 24);
  }
  return image;
}

Result<void> writeNoise(const fs::path& path, int frames) {
  FilmSettings settings;
  settings.width = settings.height = 128;
  settings.quality = 5;
  auto writer = FilmWriter::open(path, settings, nullptr);
  if (!writer) return tl::unexpected(writer.error());
  for (int i = 0; i < frames; ++i) {
    if (auto good = writer->add(noise(settings, static_cast<unsigned>(i))); !good) return good;
  }
  return writer->finish();
}

TEST(FilmFile, HasItsTableOfContentsInFront) {
  const test::TemporaryFolder folder;
  const Sound sound = test::clicksAtSamples({5000}, 48000, 48000);
  test::writeFilm(folder / "film.mp4", smallSettings(), 30, &sound);
  const auto boxes = test::boxesOf(folder / "film.mp4");
  const auto place = [&](const char* name) {
    return std::find(boxes.begin(), boxes.end(), name) - boxes.begin();
  };
  EXPECT_EQ(boxes.at(0), "ftyp");
  EXPECT_LT(place("moov"), place("mdat"));
  EXPECT_LT(place("mdat"), static_cast<std::ptrdiff_t>(boxes.size()));
  EXPECT_THAT(folder.names(), ElementsAre("film.mp4"));
}

TEST(FilmFile, SameInputGivesTheSameBytes) {
  const test::TemporaryFolder folder;
  const Sound sound = test::clicksAtSamples({5000}, 44100, 44100);
  test::writeFilm(folder / "one.mp4", smallSettings(), 40, &sound);
  test::writeFilm(folder / "two.mp4", smallSettings(), 40, &sound);
  EXPECT_TRUE(test::readText(folder / "one.mp4") == test::readText(folder / "two.mp4"));
}

TEST(FilmFile, IsSeenOnlyWhenItIsWhole) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "film.mp4", "older");
  const FilmSettings settings = smallSettings();
  auto writer = FilmWriter::open(folder / "film.mp4", settings, nullptr);
  ASSERT_TRUE(writer && writer->add(test::movingPicture(settings, 0)));
  EXPECT_EQ(test::readText(folder / "film.mp4"), "older");
  EXPECT_EQ(folder.names().size(), 2u);
  EXPECT_EQ(folder.names().at(0).substr(0, 10), ".film.mp4.");
  ASSERT_TRUE(writer->finish());
  EXPECT_THAT(folder.names(), ElementsAre("film.mp4"));
  EXPECT_EQ(test::readFilm(folder / "film.mp4").frames.size(), 1u);
}

TEST(FilmFile, LeavesNothingWhenItIsDropped) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "film.mp4", "older");
  const Sound sound = test::clicksAtSamples({5000}, 44100, 44100);
  const FilmSettings settings = smallSettings();
  for (const int frames : {0, 1, 40}) {
    auto writer = FilmWriter::open(folder / "film.mp4", settings, &sound);
    ASSERT_TRUE(writer);
    FilmWriter moved = std::move(*writer);
    for (int i = 0; i < frames; ++i) ASSERT_TRUE(moved.add(test::movingPicture(settings, i)));
  }
  EXPECT_THAT(folder.names(), ElementsAre("film.mp4"));
  EXPECT_EQ(test::readText(folder / "film.mp4"), "older");
}

TEST(FilmFile, GivesThePermissionsThatTheUserAskedFor) {
  const test::TemporaryFolder folder;
  const mode_t before = ::umask(027);
  test::writeFilm(folder / "film.mp4", smallSettings(), 1);
  ::umask(before);
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "film.mp4").permissions()), 0640u);
}

TEST(FilmFile, AcceptsAnyName) {
  const test::TemporaryFolder folder;
  const std::string name = "a film: 100% \"\xc3\xa4\" ?x=1#2";
  test::writeFilm(folder / name, smallSettings(), 1);
  EXPECT_THAT(folder.names(), ElementsAre(name));
}

TEST(FilmFile, WhereNothingCanBeWrittenIsNamed) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "file", "x");
  fs::create_directory(folder / "folder.mp4");
  for (const char* name : {"none/film.mp4", "file/film.mp4", "folder.mp4"}) {
    const auto writer = FilmWriter::open(folder / name, smallSettings(), nullptr);
    ASSERT_FALSE(writer) << name;
    EXPECT_EQ(writer.error().code, ErrorCode::kBadInput) << name;
    EXPECT_EQ(writer.error().place, (folder / name).string());
    EXPECT_NE(writer.error().remedy, "");
  }
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(FilmFile, AFullDiskIsAnErrorWithoutFragments) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "film.mp4", "older");
  // Full while frames are added, and only when the last of them leaves the buffer.
  for (const auto& [bytes, frames] : {std::pair{rlim_t{300000}, 60}, {rlim_t{10000}, 3}}) {
    const SmallDisk disk(bytes);
    const auto result = writeNoise(folder / "film.mp4", frames);
    ASSERT_FALSE(result) << bytes;
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
    EXPECT_EQ(result.error().place, (folder / "film.mp4").string());
    EXPECT_THAT(result.error().message, HasSubstr("cannot be written: File too large"));
  }
  EXPECT_THAT(folder.names(), ElementsAre("film.mp4"));
  EXPECT_EQ(test::readText(folder / "film.mp4"), "older");
}

// The second pass makes room for the table of contents at the front.
TEST(FilmFile, ADiskThatFillsAtTheVeryEndIsAnError) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(writeNoise(folder / "film.mp4", 5));
  const auto size = fs::file_size(folder / "film.mp4");
  fs::remove(folder / "film.mp4");
  const SmallDisk disk(size - 100);
  const auto result = writeNoise(folder / "film.mp4", 5);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(FilmFile, LibavPrintsNothing) {
  const test::TemporaryFolder folder;
  const Sound sound = test::clicksAtSamples({5000}, 44100, 44100);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  test::writeFilm(folder / "film.mp4", smallSettings(), 10, &sound);
  {
    const SmallDisk disk(1000);
    EXPECT_FALSE(writeNoise(folder / "noise.mp4", 10));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace ifa
