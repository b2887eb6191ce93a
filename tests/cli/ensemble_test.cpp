// SPDX-License-Identifier: Apache-2.0
// `ifa ensemble` as a user calls it, and what `ifa verify` and `ifa render` make of the result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "support/midi_bytes.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::noteOff;
using test::noteOn;
using test::runProgram;
using testing::HasSubstr;

// Two channels, two notes each, 5 ms a tick.
std::string tune() {
  return test::midiFile(0, 100,
                        {noteOn(0, 60, 100, 1) + noteOn(20, 60, 100, 2) + noteOff(10, 60, 1) +
                         noteOff(0, 60, 2) + noteOn(10, 60, 90, 1) + noteOn(20, 60, 90, 2)});
}

TEST(EnsembleCommand, PlaysAMidiFileAndItsResultHolds) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "tune.mid", tune());
  const std::string out = (folder / "out").string();
  const auto made = runProgram(
      {"ensemble", (folder / "tune.mid").string(), "--object", "d6", "-o", out, "--no-film"});
  ASSERT_EQ(made.exit, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(HasSubstr("track-1-channel-1: d6 on desk, 2 notes"),
                              HasSubstr("track-1-channel-2"), HasSubstr("nearest: ")));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/ensemble.mp4"));
  const auto verified = runProgram({"verify", out});
  EXPECT_EQ(verified.exit, 0) << verified.err;
  EXPECT_THAT(verified.out,
              AllOf(HasSubstr("track-1-channel-2: the audit holds"), HasSubstr("nearest: ")));
  EXPECT_EQ(runProgram({"verify", out + "/bodies/track-1-channel-1"}).exit, 0);
  const auto drawn = runProgram({"render", out, "-o", (folder / "still.png").string(), "--at",
                                 "0.7", "--size", "64x64", "--overlay"});
  EXPECT_EQ(drawn.exit, 0) << drawn.err;
  const auto mixed = runProgram(
      {"render", out, out + "/bodies/track-1-channel-1", "-o", (folder / "two.png").string()});
  EXPECT_EQ(mixed.exit, 2) << mixed.err;

  // The same die twice in one place is found out.
  std::string text = test::readText(folder / "out/ensemble.json");
  const auto first = text.find("  {"), second = text.find("  {", first + 1);
  const std::string body = text.substr(first, text.find('}', first) + 1 - first);
  text.replace(second, text.find('}', second) + 1 - second, body);
  test::writeText(folder / "out/ensemble.json", text);
  const auto damaged = runProgram({"verify", out});
  EXPECT_EQ(damaged.exit, 4);
  EXPECT_THAT(damaged.err, HasSubstr("bodies meet"));
}

TEST(EnsembleCommand, RefusesWhatMakesNoSense) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "tune.mid", tune());
  const std::string midi = (folder / "tune.mid").string(), out = (folder / "out").string();
  EXPECT_EQ(runProgram({"ensemble", midi, "-o", out}).exit, 2) << "no object";
  EXPECT_EQ(runProgram({"ensemble", midi, "--object", "d6"}).exit, 2) << "no output";
  EXPECT_EQ(runProgram({"ensemble", "no.json", "-o", out}).exit, 3);
  test::writeText(folder / "bad.json", "{\"format\": \"inverse-foley-score\"}");
  const auto bad = runProgram({"ensemble", (folder / "bad.json").string(), "-o", out});
  EXPECT_EQ(bad.exit, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.json: version"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace ifa
