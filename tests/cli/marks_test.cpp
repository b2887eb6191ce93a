// SPDX-License-Identifier: Apache-2.0
// Marks of every kind, in and out, and sounds at the edges of what is a sound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "run_program.h"
#include "support/clicks.h"
#include "support/midi_bytes.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class Marks : public testing::Test {
 protected:
  void SetUp() override { writeClicks(folder_ / "a.wav", kClicks, 1.0); }

  /// Starts of the contacts of a motion to `sound`, in its file, s.
  std::vector<double> targetsOf(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(),
                     {"--object", "Eraser", "--formats", "json", "-o", folder_ / "out"});
    const auto result = runProgram(arguments);
    EXPECT_THAT(result.exit, testing::AnyOf(0, 4)) << result.err;
    said_ = result.err;
    const auto motion = nlohmann::json::parse(readText(folder_ / "out/motion.json"));
    std::vector<double> times;
    for (const auto& contact : motion.at("contacts")) times.push_back(contact.at("target_time"));
    return times;
  }

  const std::vector<Click> kClicks = {{0.20, 0.9}, {0.41, 0.6}, {0.53, 0.4}};
  TemporaryFolder folder_;
  std::string said_;
};

TEST_F(Marks, WhatDetectWritesIsWhatSyncReads) {
  ASSERT_EQ(runProgram({"detect", folder_ / "a.wav", "-o", folder_ / "m.txt"}).exit, 0);
  const auto expected = targetsOf({"sync", folder_ / "a.wav", "--labels", folder_ / "m.txt"});
  ASSERT_EQ(expected.size(), kClicks.size());
  for (const char* name : {"m.wav", "m.csv", "m.json"}) {
    const auto written = runProgram({"detect", folder_ / "a.wav", "-o", folder_ / name});
    EXPECT_EQ(written.exit, 0) << written.err;
    EXPECT_THAT(written.out, HasSubstr("3 contacts written to"));
    const auto times = targetsOf({"sync", folder_ / "a.wav", "--labels", folder_ / name});
    ASSERT_EQ(times.size(), expected.size()) << name;
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(times[i], expected[i], 1.0000001e-6) << name;
    }
  }
}

TEST_F(Marks, CuePointsOfTheSoundCountAndSyncSaysSo) {
  ASSERT_EQ(
      runProgram({"detect", folder_ / "a.wav", "--no-terminal", "-o", folder_ / "m.wav"}).exit, 0);
  EXPECT_EQ(targetsOf({"sync", folder_ / "m.wav"}).size(), 3U);
  EXPECT_THAT(said_, AllOf(HasSubstr("m.wav: its cue points (3)"), HasSubstr("--ignore-cues")));
  targetsOf({"sync", folder_ / "m.wav", "--ignore-cues"});
  EXPECT_THAT(said_, testing::Not(HasSubstr("cue points")));
}

TEST_F(Marks, MidiIsASoundWithoutASound) {
  writeText(folder_ / "a.mid",
            midiFile(1, 100, {tempo(0, 200000), noteOn(50, 60, 127) + noteOn(105, 60, 80, 10)}));
  const auto times = targetsOf({"sync", folder_ / "a.mid"});
  ASSERT_EQ(times.size(), 2U);
  EXPECT_NEAR(times[1], 0.21, 1e-9);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/sound.wav"));
  EXPECT_EQ(targetsOf({"sync", folder_ / "a.mid", "--midi-channel", "10"}).size(), 1U);
}

TEST_F(Marks, DamagedMarksAreBadInputWithTheirPlace) {
  writeText(folder_ / "a.mid", midiFile(0, 96, {quantity(0) + bytesOf({60, 90})}));
  writeText(folder_ / "a.csv", "time\n0.2\nx\n");
  writeText(folder_ / "b.wav",
            readText(folder_ / "a.wav") + "cue " + std::string("\4\0\0\0\7\0\0\0", 8));
  for (const auto& [name, place] :
       {std::pair("a.mid", "a.mid, byte 23"), {"a.csv", "a.csv:3"}, {"b.wav", "b.wav, byte "}}) {
    const auto result = runProgram({"sync", folder_ / "a.wav", "--labels", folder_ / name,
                                    "--object", "Eraser", "-o", folder_ / "out"});
    EXPECT_EQ(result.exit, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr(place));
  }
  const auto midi = runProgram({"detect", folder_ / "a.wav", "-o", folder_ / "out.mid"});
  EXPECT_EQ(midi.exit, 2);
  EXPECT_THAT(midi.err, HasSubstr(".csv"));
}

/// A sound of clicks in all channels, every tenth of a second, the first at 20 ms.
void writeFrames(const std::filesystem::path& path, int format, int rate, int channels,
                 std::size_t frames, float spoilt = 0) {
  SF_INFO info{};
  info.samplerate = rate;
  info.channels = channels;
  info.format = format;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  ASSERT_NE(file, nullptr) << sf_strerror(nullptr);
  const auto period = static_cast<std::size_t>(rate / 10);
  std::vector<float> second(static_cast<std::size_t>(rate * channels));
  for (std::size_t i = 0; i < second.size(); ++i) {
    const double age =
        (static_cast<double>(i / static_cast<std::size_t>(channels) % period)) / rate - 0.02;
    second[i] =
        age < 0 ? 0 : static_cast<float>(0.7 * std::exp(-age / 0.003) * std::cos(age * 6e3));
  }
  if (frames == 1) second.assign(static_cast<std::size_t>(channels), 0.5F);
  if (spoilt != 0) second[second.size() / 2] = spoilt;
  for (std::size_t done = 0; done < frames; done += static_cast<std::size_t>(rate)) {
    const auto count = std::min<std::size_t>(frames - done, static_cast<std::size_t>(rate));
    ASSERT_EQ(sf_writef_float(file, second.data(), static_cast<sf_count_t>(count)),
              static_cast<sf_count_t>(count));
  }
  sf_close(file);
}

struct EdgeCase {
  std::string about;
  int format, rate, channels;
  std::size_t frames;
  float spoilt;
  std::string refusal;  ///< empty: it is heard
};

void PrintTo(const EdgeCase& edge, std::ostream* stream) { *stream << edge.about; }

class EdgeSounds : public testing::TestWithParam<EdgeCase> {};

TEST_P(EdgeSounds, AreHeardOrRefusedWithTheReason) {
  const EdgeCase& edge = GetParam();
  const TemporaryFolder folder;
  writeFrames(folder / "a.wav", edge.format, edge.rate, edge.channels, edge.frames, edge.spoilt);
  for (const char* out : {"a.txt", "out.wav"}) {
    const auto result = runProgram({"detect", folder / "a.wav", "-o", folder / out});
    if (edge.refusal.empty()) {
      EXPECT_EQ(result.exit, 0) << result.err;
      EXPECT_THAT(result.out,
                  HasSubstr(edge.frames > 1000 * 1000 ? "36000 contacts" : "10 contacts"));
    } else {
      EXPECT_EQ(result.exit, 3) << result.err;
      EXPECT_THAT(result.err, AllOf(HasSubstr("a.wav"), HasSubstr(edge.refusal)));
      EXPECT_FALSE(std::filesystem::exists(folder / out));
    }
  }
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kWav16 = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
constexpr int kWavFloat = SF_FORMAT_WAV | SF_FORMAT_FLOAT;

INSTANTIATE_TEST_SUITE_P(
    Cases, EdgeSounds,
    testing::Values(
        EdgeCase{"one sample", kWav16, 44100, 1, 1, 0, "no contact"},
        EdgeCase{"no sample", kWav16, 44100, 1, 0, 0, "holds no samples"},
        EdgeCase{"eight channels", SF_FORMAT_WAVEX | SF_FORMAT_PCM_16, 44100, 8, 44100, 0, ""},
        EdgeCase{"192 kHz", SF_FORMAT_WAV | SF_FORMAT_PCM_24, 192000, 2, 192000, 0, ""},
        EdgeCase{"eight bits", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 22050, 1, 22050, 0, ""},
        EdgeCase{"no number", kWavFloat, 44100, 1, 44100, kNan, "sample 22050 of channel 1"},
        EdgeCase{"infinity", kWavFloat, 44100, 2, 44100, kInfinity, "sample 22050 of channel 1"},
        EdgeCase{"over an hour", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 4000, 1, 3601 * 4000, 0,
                 "is longer than 3600 s"}));

// An hour of everything is volume, not code.
INSTANTIATE_TEST_SUITE_P(SlowCases, EdgeSounds,
                         testing::Values(EdgeCase{"an hour", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 8000,
                                                  1, 3600 * 8000, 0, ""}));

}  // namespace
}  // namespace ifa::test
