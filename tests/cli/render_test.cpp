// SPDX-License-Identifier: Apache-2.0
// `ifa render` from the shell's side: files, exit codes, streams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "ifa/film.h"
#include "run_program.h"
#include "support/motion_folder.h"
#include "support/read_png.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Render : public testing::Test {
 protected:
  void SetUp() override { writeMotionFolder(folder_ / "one", makeDieMotion()); }
  ProgramResult render(const std::string& output, const std::vector<std::string>& more = {},
                       const std::string& motion = "one") const {
    return runProgram(words(output, more, motion));
  }
  std::vector<std::string> words(const std::string& output, const std::vector<std::string>& more,
                                 const std::string& motion = "one") const {
    std::vector<std::string> all = {"render", folder_ / motion, "-o",    folder_ / output,
                                    "--size", "64x64",          "--fps", "8"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::vector<std::string> outputs() const { return namesBeside(folder_.path(), "one"); }
  TemporaryFolder folder_;
};

TEST_F(Render, TellsHowItIsCalled) {
  const auto result = runProgram({"render", "--help"});
  EXPECT_EQ(result.exit, 0);
  for (const char* word : {"MOTION", "--out", "--size", "--fps", "--camera", "--speed", "--mute",
                           "--shutter", "--overlay", "--side-by-side", "--floor", "--at"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
  EXPECT_EQ(runProgram({"render"}).exit, 2);
  EXPECT_EQ(runProgram({"render", folder_ / "one"}).exit, 2);
}

TEST_F(Render, WritesAContactSheet) {
  const auto result = render("sheet.png");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(linesOf(result.out), ElementsAre((folder_ / "sheet.png").string()));
  EXPECT_GT(readPng(folder_ / "sheet.png").width, 128);
  EXPECT_THAT(outputs(), ElementsAre("sheet.png"));
}

TEST_F(Render, WritesAFilm) {
  if (!filmsCanBeWritten()) GTEST_SKIP() << "built without libav";
  const auto result = render("film.mp4", {"--overlay", "--speed", "0.5", "--camera", "follow"});
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(outputs(), ElementsAre("film.mp4"));
  EXPECT_EQ(readText(folder_ / "film.mp4").substr(4, 4), "ftyp");
}

TEST_F(Render, WritesASequenceAndAStill) {
  ASSERT_EQ(render("pictures", {"--floor", "carpet"}).exit, 0);
  EXPECT_TRUE(fs::exists(folder_ / "pictures/frame-00001.png"));
  EXPECT_TRUE(fs::exists(folder_ / "pictures/sound.wav"));
  ASSERT_EQ(render("still.png", {"--floor", "carpet", "--at", "0.5"}).exit, 0);
  const Image still = readPng(folder_ / "still.png");
  EXPECT_EQ(still.rgb, readPng(folder_ / "pictures/frame-00005.png").rgb);
  ASSERT_EQ(render("low.png", {"--floor", "carpet", "--at", "0.5", "--camera", "low"}).exit, 0);
  EXPECT_NE(still.rgb, readPng(folder_ / "low.png").rgb);
}

TEST_F(Render, ShowsTwoMotionsSideBySide) {
  writeMotionFolder(folder_ / "two", makeDieMotion());
  auto all = words("both.png", {"--side-by-side", "--at", "0.3"});
  all.insert(all.begin() + 2, folder_ / "two");
  const auto result = runProgram(all);
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_EQ(readPng(folder_ / "both.png").width, 64);
}

TEST_F(Render, WarnsOfAMissingSound) {
  if (!filmsCanBeWritten()) GTEST_SKIP() << "built without libav";
  fs::remove(folder_ / "one/sound.wav");
  const auto result = render("film.mp4");
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.err, HasSubstr("sound.wav"));
  EXPECT_THAT(result.err, HasSubstr("silent"));
}

TEST_F(Render, IsTheSameForAnyNumberOfThreads) {
  ASSERT_EQ(render("one.png", {"--threads", "1"}).exit, 0);
  ASSERT_EQ(render("two.png", {"--threads", "2"}).exit, 0);
  EXPECT_TRUE(readText(folder_ / "one.png") == readText(folder_ / "two.png"));
}

TEST_F(Render, CallsThatMakeNoSenseAreUsageErrors) {
  const std::vector<std::vector<std::string>> bad = {
      {"--size", "64"},      {"--size", "65x64"}, {"--size", "64x64x64"}, {"--size", "0x0"},
      {"--size", "-64x64"},  {"--size", "ax64"},  {"--size", "99999x64"}, {"--fps", "0"},
      {"--fps", "nan"},      {"--fps", "241"},    {"--speed", "0"},       {"--speed", "5"},
      {"--shutter", "1.5"},  {"--floor", "lava"}, {"--camera", "upside"}, {"--quality", "best"},
      {"--at", "yesterday"},
  };
  for (const auto& words : bad) {
    std::vector<std::string> all = {"render", folder_ / "one", "-o", folder_ / "sheet.png"};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = runProgram(all);
    EXPECT_EQ(result.exit, 2) << words[0] << ' ' << words[1];
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr(words[0].substr(2))) << words[1];
  }
  for (const char* output : {"film.avi", "sheet.jpg"}) {
    const auto result = render(output);
    EXPECT_EQ(result.exit, 2) << output;
    EXPECT_THAT(result.err, HasSubstr(output));
  }
  EXPECT_EQ(render("film.mp4", {"--at", "0.5"}).exit, 2);
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(Render, WhatCannotBeReadOrWrittenIsBadInput) {
  writeText(folder_ / "file", "x");
  const auto before = folder_.names();
  const auto missing = render("sheet.png", {}, "nobody");
  EXPECT_EQ(missing.exit, 3);
  EXPECT_THAT(missing.err, HasSubstr("nobody"));
  for (const char* output : {"missing/film.mp4", "missing/sheet.png", "file/film.mp4",
                             "file/sheet.png", "file/pictures"}) {
    const auto result = render(output);
    EXPECT_EQ(result.exit, 3) << output << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(folder_ / output)) << output;
    EXPECT_THAT(result.out, IsEmpty());
  }
  EXPECT_EQ(runProgram({"render", folder_ / "one", "-o", "/proc/film.mp4"}).exit, 3);
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Render, BrokenMotionsAreNamed) {
  const std::string good = readText(folder_ / "one/motion.json");
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("hello"), good.substr(0, good.size() / 2)}) {
    writeText(folder_ / "one/motion.json", text);
    const auto result = render("sheet.png");
    EXPECT_EQ(result.exit, 3);
    EXPECT_THAT(result.err, HasSubstr("motion.json"));
  }
  writeText(folder_ / "one/motion.json", good);
  writeText(folder_ / "one/d6.json", "{");
  EXPECT_EQ(render("sheet.png").exit, 3);
  EXPECT_THAT(outputs(), IsEmpty());
}

TEST_F(Render, TellsAProgramWhatItDoes) {
  for (const char* output : {"sheet.png", "pictures"}) {
    const auto result = render(output, {"--json-progress"});
    ASSERT_EQ(result.exit, 0) << result.err;
    const auto lines = linesOf(result.err);
    ASSERT_GE(lines.size(), 2U);
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      const auto line = json::parse(lines[i]);
      EXPECT_EQ(line.at("type"), "progress");
      EXPECT_GE(line.at("value").get<double>(), 0.0);
      EXPECT_LE(line.at("value").get<double>(), 1.0);
    }
    EXPECT_EQ(json::parse(lines.back()).at("type"), "success");
  }
  const auto failed = render("missing/sheet.png", {"--json-progress"});
  EXPECT_EQ(failed.exit, 3);
  const auto last = json::parse(linesOf(failed.err).back());
  EXPECT_EQ(last.at("type"), "failure");
  EXPECT_EQ(last.at("code"), 3);
}

TEST_F(Render, CanBeInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    // Long enough that it is never done by then.
    const auto result = runAndSignal(
        {"render", folder_ / "one", "-o", folder_ / "pictures", "--fps", "240", "--json-progress"},
        "\"progress\"", signal);
    EXPECT_EQ(result.exit, 5) << result.err;
    EXPECT_EQ(json::parse(linesOf(result.err).back()).at("code"), 5);
    EXPECT_THAT(outputs(), IsEmpty());
  }
}

}  // namespace
}  // namespace ifa::test
