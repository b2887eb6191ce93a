// SPDX-License-Identifier: Apache-2.0
#include "signature/midi.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/midi_bytes.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::bytesOf;
using test::midiFile;
using test::noteOff;
using test::noteOn;
using test::quantity;
using test::tempo;
using testing::HasSubstr;

std::vector<Label> parsed(const std::string& bytes, const MidiOptions& options = {}) {
  auto labels = parseMidi(bytes, "a.mid", options);
  EXPECT_TRUE(labels) << labels.error().text();
  return labels.value_or(std::vector<Label>());
}

std::string complaint(const std::string& bytes, const MidiOptions& options = {}) {
  const auto labels = parseMidi(bytes, "a.mid", options);
  if (labels) return "";
  EXPECT_EQ(labels.error().code, ErrorCode::kBadInput);
  return labels.error().text();
}

std::vector<double> startsOf(const std::vector<Label>& labels) {
  std::vector<double> starts;
  for (const Label& label : labels) starts.push_back(label.start);
  return starts;
}

MATCHER_P(AreTimes, expected, "") {
  if (arg.size() != std::size(expected)) return false;
  for (std::size_t i = 0; i < arg.size(); ++i) {
    if (std::abs(arg[i] - expected[i]) > 1e-9) return false;
  }
  return true;
}

TEST(ParseMidi, NotesAreClicksWithTheirVelocities) {
  const auto labels =
      parsed(midiFile(0, 480, {noteOn(480, 60, 127) + noteOff(480, 60) + noteOn(240, 62, 64)}));
  // Half a second a beat where nothing is said.
  EXPECT_THAT(startsOf(labels), AreTimes(std::vector{0.5, 1.25}));
  for (const Label& label : labels) EXPECT_TRUE(label.isPoint());
  EXPECT_DOUBLE_EQ(*labels[0].amplitude, 1);
  EXPECT_DOUBLE_EQ(*labels[1].amplitude, 64 / 127.0);
  EXPECT_TRUE(labelsAreTerminal(labels));
}

TEST(ParseMidi, TempoChangesOfOneTrackHoldForAll) {
  const auto file = midiFile(1, 100,
                             {tempo(0, 1000000) + tempo(200, 250000) + tempo(100, 2000000),
                              noteOn(100, 60, 100) + noteOff(50, 60) + noteOn(150, 60, 100) +
                                  noteOff(0, 60) + noteOn(50, 60, 100)});
  // 1 s a beat for two beats, a quarter for one, then two.
  EXPECT_THAT(startsOf(parsed(file)), AreTimes(std::vector{1.0, 2.25, 3.25}));
}

TEST(ParseMidi, ChangesWithinATickRangeAreExact) {
  // Times are sums of whole microseconds: nothing may be lost on the way.
  std::string changes, notes;
  double expected = 0;
  std::vector<double> times;
  for (int i = 0; i < 200; ++i) {
    const auto microseconds = static_cast<std::uint32_t>(300000 + 1234 * i);
    changes += tempo(i == 0 ? 0 : 96, microseconds);
    notes += noteOn(96, 60, 90);
    expected += microseconds * 1e-6;
    times.push_back(expected);
  }
  EXPECT_THAT(startsOf(parsed(midiFile(1, 96, {changes, notes}))), AreTimes(times));
}

TEST(ParseMidi, RunningStatusAndAVelocityOfZero) {
  const std::string track = noteOn(0, 60, 100) + quantity(96) + bytesOf({60, 0}) + quantity(0) +
                            bytesOf({62, 100}) + quantity(96) + bytesOf({62, 0});
  EXPECT_THAT(startsOf(parsed(midiFile(0, 96, {track}))), AreTimes(std::vector{0.0, 0.5}));
}

TEST(ParseMidi, OtherEventsAreSkipped) {
  const std::string track =
      quantity(0) + bytesOf({0xFF, 0x03, 4}) + "name" + quantity(0) +
      bytesOf({0xF0, 3, 1, 2, 0xF7}) + quantity(10) + bytesOf({0xF7, 2, 1, 2}) + quantity(0) +
      bytesOf({0xC0, 5}) + quantity(0) + bytesOf({0xB0, 7, 100}) + quantity(0) +
      bytesOf({0xE0, 0, 64}) + quantity(0) + bytesOf({0xD0, 64}) + quantity(0) +
      bytesOf({0xA0, 60, 64}) + noteOn(86, 60, 100) +
      // Nothing new is said of the status after a meta event.
      quantity(0) + bytesOf({0xFF, 0x06, 1}) + "x" + quantity(96) + bytesOf({64, 100});
  std::string file = midiFile(0, 96, {track});
  file.insert(14, "XFIH" + test::bigEndian(2, 4) + "??");  // a chunk that nobody knows
  EXPECT_THAT(startsOf(parsed(file + "rest")), AreTimes(std::vector{0.5, 1.0}));
}

TEST(ParseMidi, NotesOfOneMomentAreOneContact) {
  const auto labels = parsed(midiFile(
      1, 96,
      {noteOn(96, 60, 30) + noteOn(0, 64, 90), noteOn(96, 40, 50, 10) + noteOn(1, 41, 20, 10)}));
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_DOUBLE_EQ(*labels[0].amplitude, 90 / 127.0) << "the loudest";
}

TEST(ParseMidi, TracksAndChannelsCanBeChosen) {
  const auto file = midiFile(
      1, 96,
      {tempo(0, 1000000), noteOn(96, 60, 90, 1) + noteOn(96, 60, 90, 2), noteOn(48, 60, 90, 10)});
  EXPECT_THAT(startsOf(parsed(file)), AreTimes(std::vector{0.5, 1.0, 2.0}));
  EXPECT_THAT(startsOf(parsed(file, {2, 0, false})), AreTimes(std::vector{1.0, 2.0}));
  EXPECT_THAT(startsOf(parsed(file, {0, 10, false})), AreTimes(std::vector{0.5}));
  EXPECT_THAT(startsOf(parsed(file, {2, 2, false})), AreTimes(std::vector{2.0}));
  EXPECT_THAT(complaint(file, {1, 0, false}), HasSubstr("no such notes"));
  EXPECT_THAT(complaint(file, {0, 16, false}), HasSubstr("no such notes"));
}

TEST(ParseMidi, FormatTwoIsOneTuneAtATime) {
  const auto file = midiFile(2, 96, {tempo(0, 1000000) + noteOn(96, 60, 90), noteOn(96, 60, 90)});
  EXPECT_THAT(complaint(file), HasSubstr("tracks 1, 2 with --midi-track"));
  EXPECT_THAT(startsOf(parsed(file, {1, 0, false})), AreTimes(std::vector{1.0}));
  EXPECT_THAT(startsOf(parsed(file, {2, 0, false})), AreTimes(std::vector{0.5}))
      << "the first track's tempo is its own";
  EXPECT_THAT(startsOf(parsed(midiFile(2, 96, {noteOn(96, 60, 90)}))), AreTimes(std::vector{0.5}));
}

TEST(ParseMidi, TicksCanBePartsOfFrames) {
  const auto at = [](int frames, int ticks) {
    const int division = (256 - frames) << 8 | ticks;
    // Tempo says nothing about frames.
    return startsOf(parsed(midiFile(0, division, {tempo(0, 1) + noteOn(1000, 60, 90)})));
  };
  EXPECT_THAT(at(25, 40), AreTimes(std::vector{1.0}));
  EXPECT_THAT(at(24, 100), AreTimes(std::vector{1000 / 2400.0}));
  EXPECT_THAT(at(29, 80), AreTimes(std::vector{1000 * 1001 / (80 * 30000.0)}));
  EXPECT_THAT(at(30, 10), AreTimes(std::vector{1000 / 300.0}));
}

TEST(ParseMidi, NotesAreRattlesWhereThatIsAskedFor) {
  const auto file = midiFile(0, 96,
                             {noteOn(0, 60, 90) + noteOff(48, 60) + noteOn(48, 62, 90) +
                              noteOn(96, 64, 90) + noteOff(96, 62)});
  const auto labels = parsed(file, {0, 0, true});
  ASSERT_EQ(labels.size(), 3U);
  EXPECT_DOUBLE_EQ(labels[0].end, 0.25);
  EXPECT_DOUBLE_EQ(labels[1].end, 1.0) << "until the next one starts";
  EXPECT_DOUBLE_EQ(labels[2].end, 1.5) << "never ended: until the track does";
}

TEST(ParseMidi, EachBadFileHasItsOwnMessage) {
  const std::string good = midiFile(0, 96, {noteOn(96, 60, 90)});
  EXPECT_EQ(complaint(good), "");
  EXPECT_THAT(complaint(""), HasSubstr("a.mid, byte 0: is not a Standard MIDI File"));
  EXPECT_THAT(complaint("RIFF"), HasSubstr("not a Standard MIDI File"));
  EXPECT_THAT(complaint(good.substr(0, 9)), HasSubstr("header is cut off"));
  EXPECT_THAT(complaint(good.substr(0, good.size() - 6)), HasSubstr("track 1 is cut off"));
  EXPECT_THAT(complaint(midiFile(3, 96, {})), HasSubstr("format 3"));
  EXPECT_THAT(complaint(midiFile(0, 0, {})), HasSubstr("no ticks"));
  EXPECT_THAT(complaint(midiFile(0, (256 - 25) << 8, {})), HasSubstr("no ticks"));
  EXPECT_THAT(complaint(midiFile(0, (256 - 26) << 8 | 4, {})), HasSubstr("26 frames"));
  EXPECT_THAT(complaint(midiFile(0, 96, {})), HasSubstr("holds no notes"));
  EXPECT_THAT(complaint(midiFile(0, 96, {quantity(0) + bytesOf({60, 90})})),
              HasSubstr("byte 23: data comes before any event"));
  EXPECT_THAT(complaint(midiFile(0, 96, {quantity(0) + bytesOf({0x90, 60, 0x90})})),
              HasSubstr("byte 25: "));
  EXPECT_THAT(complaint(midiFile(0, 96, {quantity(0) + bytesOf({0xF8})})), HasSubstr("event F8"));
  EXPECT_THAT(complaint(midiFile(0, 96, {bytesOf({255, 255, 255, 255, 127})})),
              HasSubstr("four bytes"));
  EXPECT_THAT(complaint(midiFile(0, 96, {quantity(0) + bytesOf({0xF0, 100, 1})})),
              HasSubstr("cut off"));
  EXPECT_THAT(complaint(midiFile(0, 96, {tempo(0, 0) + noteOn(0, 60, 90)})), HasSubstr("tempo"));
  EXPECT_THAT(complaint(midiFile(0, 1, {noteOn(7201, 60, 90)})), HasSubstr("after 3600 s"));
}

TEST(ReadMidi, MissingFile) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(readMidi(folder / "none.mid"));
}

TEST(ParseMidiNotes, KeepsEveryNoteWithItsTrackAndKey) {
  const auto notes = parseMidiNotes(midiFile(1, 100,
                                             {tempo(0, 1000000) + noteOn(100, 42, 127, 10),
                                              noteOn(50, 36, 64, 10) + noteOn(50, 38, 32, 10)}),
                                    "a.mid");
  ASSERT_TRUE(notes) << notes.error().text();
  ASSERT_EQ(notes->size(), 3U);
  EXPECT_NEAR((*notes)[0].time, 0.5, 1e-9);
  EXPECT_EQ((*notes)[0].key, 36);
  EXPECT_EQ((*notes)[0].track, 2);
  EXPECT_EQ((*notes)[0].channel, 10);
  EXPECT_DOUBLE_EQ((*notes)[0].velocity, 64 / 127.0);
  EXPECT_EQ((*notes)[1].key, 42) << "of two at once that of the first track";
  EXPECT_NEAR((*notes)[2].time, 1, 1e-9);
}

TEST(ParseMidiNotes, RefusesTunesThatDoNotBelongTogetherAndNoNotes) {
  const auto two = parseMidiNotes(midiFile(2, 100, {noteOn(0, 1, 1)}), "a.mid");
  ASSERT_FALSE(two);
  EXPECT_THAT(two.error().text(), HasSubstr("format 2"));
  EXPECT_FALSE(parseMidiNotes(midiFile(1, 100, {tempo(0, 1000000)}), "a.mid"));
  EXPECT_FALSE(parseMidiNotes("RIFF", "a.mid"));
}

}  // namespace
}  // namespace ifa
