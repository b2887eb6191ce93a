// SPDX-License-Identifier: Apache-2.0
// `ifa detect`: contacts of a sound, as a table or as labels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "run_program.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::vector<Click> kClicks = {{0.20, 0.9}, {0.41, 0.6}, {0.53, 0.4}, {0.62, 0.3}};

class Detect : public testing::Test {
 protected:
  void SetUp() override { writeClicks(folder_ / "a.wav", kClicks, 1.0); }
  TemporaryFolder folder_;
};

TEST_F(Detect, WritesALabelAtEveryClick) {
  const auto result = runProgram({"detect", folder_ / "a.wav", "-o", folder_ / "a.txt"});
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, HasSubstr("4 contacts written to " + (folder_ / "a.txt").string()));
  const auto lines = linesOf(readText(folder_ / "a.txt"));
  ASSERT_THAT(lines, SizeIs(kClicks.size()));
  for (std::size_t i = 0; i < kClicks.size(); ++i) {
    double start = -1, end = -1;
    std::istringstream(lines[i]) >> start >> end;
    EXPECT_NEAR(start, kClicks[i].time, 0.010) << lines[i];
    EXPECT_GE(end, start) << lines[i];
    EXPECT_LT(end, start + 0.05) << lines[i];
  }
  EXPECT_THAT(lines.back(), EndsWith("terminal"));
}

TEST_F(Detect, ShowsATableWithoutAnOutput) {
  const auto before = folder_.names();
  const auto result = runProgram({"detect", folder_ / "a.wav"});
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(linesOf(result.out), SizeIs(1 + kClicks.size()));
  EXPECT_THAT(linesOf(result.out).front(), HasSubstr("confidence"));
  EXPECT_THAT(linesOf(result.out)[1], HasSubstr(" 1.00 "));  // a click in silence
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Detect, LabelsCanSayThatNothingComesToRest) {
  const auto result =
      runProgram({"detect", folder_ / "a.wav", "--no-terminal", "-o", folder_ / "a.txt"});
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(linesOf(readText(folder_ / "a.txt")).back(), EndsWith("non-terminal"));
}

TEST_F(Detect, LabelsAreWhatSyncReads) {
  ASSERT_EQ(runProgram({"detect", folder_ / "a.wav", "-o", folder_ / "a.txt"}).exit, 0);
  const auto result =
      runProgram({"sync", folder_ / "a.wav", "--labels", folder_ / "a.txt", "--object", "Eraser",
                  "--formats", "json", "-o", folder_ / "out"});
  EXPECT_THAT(result.exit, testing::AnyOf(0, 4)) << result.err;
  const auto motion = nlohmann::json::parse(readText(folder_ / "out/motion.json"));
  EXPECT_NEAR(motion.at("contacts")[0].at("target_time").get<double>(), 0, 1e-12);
}

TEST_F(Detect, FewerContactsAreFoundWhereTheyMustBeSurer) {
  // Thirty decibels under the first, and over no noise: only the range leaves it out.
  writeClicks(folder_ / "a.wav", {{0.2, 0.9}, {0.5, 0.03}}, 1.0);
  const auto all = runProgram({"detect", folder_ / "a.wav"});
  EXPECT_THAT(linesOf(all.out), SizeIs(3)) << all.out;
  const auto loud = runProgram({"detect", folder_ / "a.wav", "--range", "20"});
  EXPECT_THAT(linesOf(loud.out), SizeIs(2)) << loud.out;
}

TEST_F(Detect, WhatIsNoSoundIsBadInput) {
  writeText(folder_ / "empty.wav", "");
  writeText(folder_ / "text.wav", "hello, I am text");
  writeClicks(folder_ / "silent.wav", {}, 1.0);
  std::filesystem::create_directory(folder_ / "folder.wav");
  const auto before = folder_.names();
  for (const auto& [name, message] : {std::pair{"none.wav", "no such sound file"},
                                      {"empty.wav", "is an empty file"},
                                      {"text.wav", "is not a sound that can be read"},
                                      {"silent.wav", "is silent"},
                                      {"folder.wav", "is a folder"}}) {
    const auto result = runProgram({"detect", folder_ / name, "-o", folder_ / "out.txt"});
    EXPECT_EQ(result.exit, 3) << name;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(linesOf(result.err), SizeIs(1)) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr(name), HasSubstr(message)));
  }
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Detect, OutputThatCannotBeWrittenIsBadInput) {
  for (const std::string& out : {(folder_ / "none/a.txt").string(), folder_.path().string()}) {
    const auto result = runProgram({"detect", folder_ / "a.wav", "-o", out});
    EXPECT_EQ(result.exit, 3) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, HasSubstr(out));
  }
  EXPECT_THAT(folder_.names(), SizeIs(1));
}

TEST_F(Detect, ALongerTimeBeforeTakesMoreOfTheLastClickIn) {
  writeClicks(folder_ / "pair.wav", {{0.20, 0.9}, {0.24, 0.6}}, 0.5);
  const auto secondRise = [&](const std::string& before) {
    const auto result = runProgram({"detect", folder_ / "pair.wav", "--before", before});
    const auto lines = linesOf(result.out);
    EXPECT_THAT(lines, SizeIs(3)) << result.out << result.err;
    double start = 0, level = 0, rise = 0;
    std::string end;
    std::istringstream(lines.back()) >> start >> end >> level >> rise;
    EXPECT_NEAR(start, 0.24, 0.002);
    return rise;
  };
  EXPECT_GT(secondRise("0.008"), secondRise("0.045") + 3);
}

TEST_F(Detect, TheSoundIsNotOverwritten) {
  const auto sound = readText(folder_ / "a.wav");
  const auto result = runProgram({"detect", folder_ / "a.wav", "-o", folder_ / "a.wav"});
  EXPECT_EQ(result.exit, 2);
  EXPECT_THAT(result.err, HasSubstr("overwritten"));
  EXPECT_EQ(readText(folder_ / "a.wav"), sound);
}

TEST_F(Detect, CallsThatMakeNoSenseAreUsageErrors) {
  const std::string sound = folder_ / "a.wav";
  const std::vector<std::vector<std::string>> calls = {{"detect"},
                                                       {"detect", sound, sound},
                                                       {"detect", sound, "--min-rise", "0"},
                                                       {"detect", sound, "--range", "nan"},
                                                       {"detect", sound, "--after", "0"},
                                                       {"detect", sound, "--before", "1"},
                                                       {"detect", sound, "-o"}};
  for (const auto& call : calls) {
    const auto result = runProgram(call);
    EXPECT_EQ(result.exit, 2) << testing::PrintToString(call);
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(linesOf(result.err), SizeIs(1)) << result.err;
  }
}

// The library that reads MP3 would write a line for every frame that it does not understand.
std::string brokenFrames() {
  std::string bytes;
  for (unsigned i = 0, noise = 1; i < 20 * 417; ++i) {
    noise = noise * 1664525U + 1013904223U;
    const char header[] = {'\xff', '\xfb', '\x90', '\x64'};
    bytes += i % 417 < 4 ? header[i % 417] : static_cast<char>(noise >> 24);
  }
  return bytes;
}

TEST_F(Detect, BrokenMp3SaysNoMoreThanWeDo) {
  writeText(folder_ / "text.mp3", "hello, I am text");
  writeText(folder_ / "broken.mp3", brokenFrames());
  for (const char* name : {"text.mp3", "broken.mp3"}) {
    const auto plain = runProgram({"detect", folder_ / name});
    if (plain.exit == 0) {
      EXPECT_THAT(plain.err, IsEmpty()) << name;
    } else {
      EXPECT_EQ(plain.exit, 3) << name;
      EXPECT_THAT(linesOf(plain.err), SizeIs(1)) << plain.err;
      EXPECT_THAT(plain.err, HasSubstr(name));
    }
  }
  // What a program reads stays JSON.
  const auto lines = linesOf(runProgram({"--json-progress", "detect", folder_ / "text.mp3"}).err);
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_EQ(nlohmann::json::parse(lines.front()).at("code"), 3);
}

}  // namespace
}  // namespace ifa::test
