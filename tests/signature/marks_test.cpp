// SPDX-License-Identifier: Apache-2.0
// What is written in any format reads back as the same signature.
#include "signature/marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "signature/signature.h"
#include "sound/synthetic_sound.h"
#include "support/midi_bytes.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

constexpr double kMicrosecond = 1.0000001e-6;

/// Labels somewhere in a sound of ten seconds, on no sample in particular. Some are in doubt, and
/// some are so near to the one before that they become one event with it.
std::vector<Label> drawLabels() {
  const auto draws = *rc::gen::nonEmpty(
      rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>()));
  std::vector<Label> labels;
  double time = draws[0] % 1000000 * 1.0000003e-6;
  for (std::size_t i = 0; i < draws.size() && time < 9; ++i) {
    Label label;
    label.start = time;
    label.end = time + (draws[i] % 3 == 0 ? 0.0101 + draws[i] % 99991 * 1.000007e-6 : 0);
    label.text = "c, \"" + std::to_string(i) + "\"";
    if (draws[i] % 5 < 2) label.weight = draws[i] % 90 / 100.0;
    labels.push_back(label);
    time = label.end + (draws[i] % 7 == 0 ? 0.004 : 0.011) + draws[i] / 1e10;
  }
  labels.back().text += draws[0] % 2 == 0 ? " terminal" : " non-terminal";
  return labels;
}

Sound noise(int rate) {
  Sound sound = test::silence(10, rate);
  test::addNoise(sound, 0.5, 3);
  return sound;
}

/// Times, durations and how a signature ends: what every format keeps.
void compareTimes(const ContactSignature& before, const ContactSignature& after) {
  RC_ASSERT(after.terminal == before.terminal);
  RC_ASSERT(after.events.size() == before.events.size());
  RC_ASSERT(std::abs(after.firstContact - before.firstContact) < kMicrosecond);
  for (std::size_t i = 0; i < before.events.size(); ++i) {
    const SignatureEvent &one = before.events[i], &other = after.events[i];
    // Both ends of a span may be rounded.
    RC_ASSERT(std::abs(other.time - one.time) < kMicrosecond);
    RC_ASSERT(std::abs(other.duration - one.duration) < kMicrosecond);
  }
}

/// How loud the events are and how surely they were heard: tables and signatures.
void compareValues(const ContactSignature& before, const ContactSignature& after) {
  for (std::size_t i = 0; i < before.events.size(); ++i) {
    const SignatureEvent &one = before.events[i], &other = after.events[i];
    RC_ASSERT(other.weight == one.weight);
    RC_ASSERT(std::abs(other.amplitude - one.amplitude) < 1e-8 * (1 + one.amplitude));
    RC_ASSERT(std::abs(other.centroid - one.centroid) < kMicrosecond);
  }
}

/// Other moments at which events may begin: signatures alone.
void compareAlternatives(const ContactSignature& before, const ContactSignature& after) {
  for (std::size_t i = 0; i < before.events.size(); ++i) {
    const auto &one = before.events[i].alternatives, &other = after.events[i].alternatives;
    RC_ASSERT(other.size() == one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      RC_ASSERT(std::abs(other[k].time - one[k].time) < kMicrosecond);
      RC_ASSERT(other[k].cost == one[k].cost);
    }
  }
}

class ReadsBack : public testing::TestWithParam<std::pair<std::string, int>> {};

TEST_P(ReadsBack, TheSameSignatureToTheMicrosecond) {
  const auto& [name, rate] = GetParam();
  const bool isSignature = name.ends_with(".json");
  const bool hasValues = isSignature || name.ends_with("sv");
  const test::TemporaryFolder folder;
  const Sound sound = noise(rate);
  ASSERT_TRUE(writeWav(folder / "in.wav", sound));
  EXPECT_TRUE(rc::check(name, [&, &name = name] {
    const auto labels = drawLabels();
    const auto before = signatureFromLabels(sound, labels);
    RC_ASSERT(before.has_value());
    RC_ASSERT(writeMarks(folder / name, folder / "in.wav", sound, labels).has_value());
    const auto marks = readMarks(folder / name);
    RC_ASSERT(marks.has_value());
    const auto after = signatureFromLabels(sound, *marks);
    RC_ASSERT(after.has_value());
    compareTimes(*before, *after);
    if (hasValues) {
      const auto alone = signatureWithoutSound(*marks, {}, name);
      RC_ASSERT(alone.has_value());
      for (const auto* signature : {&*after, &*alone}) {
        compareTimes(*before, *signature);
        compareValues(*before, *signature);
        if (isSignature) compareAlternatives(*before, *signature);
      }
    } else {
      // Who gives labels or cue points says that they are contacts.
      for (const SignatureEvent& event : after->events) RC_ASSERT(event.weight == 1);
    }
  }));
}

INSTANTIATE_TEST_SUITE_P(Formats, ReadsBack,
                         testing::Values(std::pair("a.txt", 8000), std::pair("a.wav", 8000),
                                         std::pair("a.wav", 44100), std::pair("a.csv", 8000),
                                         std::pair("a.tsv", 8000), std::pair("a.json", 8000)));

/// Where a sample more or less is a matter of the last digits.
TEST(ReadMarks, CuePointsHalfwayBetweenSamplesKeepTheirTimes) {
  const test::TemporaryFolder folder;
  const Sound sound = noise(44100);
  ASSERT_TRUE(writeWav(folder / "in.wav", sound));
  std::vector<Label> labels;
  for (const double off : {-4e-10, -1e-12, 0.0, 1e-12, 4e-10}) {
    Label label;
    label.start = 1 + static_cast<double>(labels.size()) + 20.5 / 44100 + off;
    label.end = label.start + 900.5 / 44100 - 2 * off;
    labels.push_back(label);
  }
  ASSERT_TRUE(writeMarks(folder / "a.wav", folder / "in.wav", sound, labels));
  const auto marks = readMarks(folder / "a.wav");
  ASSERT_TRUE(marks) << marks.error().text();
  ASSERT_EQ(marks->size(), labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_NEAR((*marks)[i].start, labels[i].start, 1e-9) << i;
    EXPECT_NEAR((*marks)[i].end, labels[i].end, 2e-9) << i;
  }
}

TEST(ReadMarks, TablesAndSignaturesKeepAmplitudesAndCentroids) {
  const test::TemporaryFolder folder;
  const Sound sound = noise(8000);
  Label roll;
  roll.start = 1;
  roll.end = 1.5;
  Label click;
  click.start = click.end = 2;
  const auto before = signatureFromLabels(sound, {roll, click}).value();
  for (const char* name : {"a.csv", "a.tsv", "a.json"}) {
    ASSERT_TRUE(writeMarks(folder / name, folder / "in.wav", sound, {roll, click}));
    const auto after = signatureWithoutSound(readMarks(folder / name).value(), {}, name).value();
    ASSERT_EQ(after.events.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(after.events[i].amplitude, before.events[i].amplitude, 1e-8) << name;
      EXPECT_NEAR(after.events[i].centroid, before.events[i].centroid, 1e-8) << name;
    }
  }
}

TEST(ReadMarks, GoesByContentBeforeItGoesByName) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "midi.txt", test::midiFile(0, 96, {test::noteOn(96, 60, 127)}));
  EXPECT_EQ(markFormatOf(folder / "midi.txt"), MarkFormat::kMidi);
  EXPECT_EQ(readMarks(folder / "midi.txt")->front().start, 0.5);
  test::writeText(folder / "labels", "0.5\t0.5\thit\n");
  EXPECT_EQ(readMarks(folder / "labels")->front().text, "hit");
  EXPECT_EQ(markFormatOf(folder / "none.MID"), MarkFormat::kMidi);
  EXPECT_EQ(markFormatOf(folder / "none.Csv"), MarkFormat::kCsv);
}

TEST(ReadMarks, AWavWithoutCuePointsIsNoLabelFile) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(writeWav(folder / "a.wav", noise(8000)));
  const auto marks = readMarks(folder / "a.wav");
  ASSERT_FALSE(marks);
  EXPECT_THAT(marks.error().text(), HasSubstr("holds no cue points"));
}

TEST(WriteMarks, MidiIsNotWritten) {
  const test::TemporaryFolder folder;
  const auto written = writeMarks(folder / "a.mid", folder / "in.wav", noise(8000), {Label{}});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace ifa
