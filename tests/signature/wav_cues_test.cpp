// SPDX-License-Identifier: Apache-2.0
#include "signature/wav_cues.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>
#include <cstring>

#include "sound/wav_chunks.h"
#include "support/clicks.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

std::string number(std::uint64_t value, int bytes = 4) { return littleEndianBytes(value, bytes); }

std::string chunk(const std::string& id, const std::string& body) {
  return id + number(body.size()) + body + std::string(body.size() % 2, '\0');
}

std::string point(std::uint32_t id, std::uint32_t position, std::uint32_t sample) {
  return number(id) + number(position) + "data" + number(0) + number(0) + number(sample);
}

/// A mono WAV file of 16 bits, 8 kHz, with these chunks behind its samples.
std::string wav(const std::string& more, const std::string& before = "", int samples = 4000) {
  const std::string body =
      "WAVE" +
      chunk("fmt ", number(1, 2) + number(1, 2) + number(8000) + number(16000) + number(2, 2) +
                        number(16, 2)) +
      before + chunk("data", std::string(static_cast<std::size_t>(2 * samples), '\1')) + more;
  return chunk("RIFF", body);
}

class WavCues : public testing::Test {
 protected:
  std::vector<Label> read(const std::string& bytes) {
    test::writeText(folder_ / "a.wav", bytes);
    auto labels = readWavCues(folder_ / "a.wav");
    EXPECT_TRUE(labels) << labels.error().text();
    return labels.value_or(std::vector<Label>());
  }
  test::TemporaryFolder folder_;
};

TEST_F(WavCues, PointsRegionsAndTheirLabels) {
  const std::string cues =
      chunk("cue ", number(3) + point(7, 800, 800) + point(3, 80, 80) + point(9, 1600, 1600));
  const std::string list =
      chunk("LIST", "adtl" + chunk("labl", number(3) + "hit" + '\0') +
                        chunk("note", number(7) + "a note" + '\0') +
                        chunk("ltxt", number(9) + number(400) + "rgn " + std::string(8, '\0') +
                                          "roll non-terminal" + '\0') +
                        chunk("labl", number(99) + "of no point" + '\0'));
  for (const std::string& bytes : {wav(cues + list), wav("", list + cues)}) {
    const auto labels = read(bytes);
    ASSERT_EQ(labels.size(), 3U);
    EXPECT_EQ(labels[0].start, 0.01);
    EXPECT_EQ(labels[0].text, "hit");
    EXPECT_EQ(labels[1].start, 0.1);
    EXPECT_EQ(labels[1].text, "a note");
    EXPECT_EQ(labels[2].start, 0.2);
    EXPECT_DOUBLE_EQ(labels[2].end, 0.25);
    EXPECT_FALSE(labelsAreTerminal(labels));
  }
}

TEST_F(WavCues, PositionsCountWhereNoOffsetsAreGiven) {
  const auto labels = read(wav(chunk("cue ", number(2) + point(1, 80, 0) + point(2, 800, 0))));
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[1].start, 0.1);
}

TEST_F(WavCues, TextsOfWindowsBecomeUtf8) {
  const auto labels =
      read(wav(chunk("cue ", number(1) + point(1, 8, 8)) +
               chunk("LIST", "adtl" + chunk("labl", number(1) + "Gl\xE4ser\n" + '\0'))));
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].text, "Gl\xC3\xA4ser ");
}

TEST_F(WavCues, NoneWhereThereAreNone) {
  EXPECT_TRUE(read(wav("")).empty());
  EXPECT_TRUE(read("hello, I am text").empty());
  EXPECT_TRUE(read("").empty());
  EXPECT_TRUE(read(wav(chunk("cue ", number(0)))).empty());
  EXPECT_FALSE(readWavCues(folder_ / "none.wav"));
}

TEST_F(WavCues, ADamagedChunkIsNamed) {
  test::writeText(folder_ / "a.wav", wav(chunk("cue ", number(5) + point(1, 8, 8))));
  const auto labels = readWavCues(folder_ / "a.wav");
  ASSERT_FALSE(labels);
  EXPECT_THAT(labels.error().text(),
              HasSubstr("a.wav, byte 8052: promises 5 cue points and holds 1"));
  EXPECT_FALSE(labels.error().remedy.empty());
}

TEST_F(WavCues, TheSixtyFourBitForm) {
  const std::string plain = wav(chunk("cue ", number(1) + point(1, 80, 80)));
  const std::string ds64 =
      chunk("ds64", number(plain.size() + 28, 8) + number(8000, 8) + number(4000, 8) + number(0));
  const std::string data = "data" + number(0xFFFFFFFF) + plain.substr(44);
  const auto labels =
      read("RF64" + number(0xFFFFFFFF) + "WAVE" + ds64 + plain.substr(12, 24) + data);
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].start, 0.01);
}

class WritesCues : public WavCues {
 protected:
  /// Writes `labels` into a.wav's copy b.wav.
  std::vector<Label> written(const std::vector<Label>& labels) {
    const auto sound = readSound(folder_ / "a.wav");
    EXPECT_TRUE(sound);
    const auto good = writeWavWithCues(folder_ / "b.wav", folder_ / "a.wav", *sound, labels);
    EXPECT_TRUE(good) << good.error().text();
    return readWavCues(folder_ / "b.wav").value_or(std::vector<Label>());
  }
  static Label label(double start, double end, const std::string& text) {
    Label made;
    made.start = start;
    made.end = end;
    made.text = text;
    return made;
  }
};

TEST_F(WritesCues, TheSoundAndItsOtherChunksStay) {
  const std::string info = chunk("LIST", "INFO" + chunk("ICMT", "hello"));
  const std::string old = chunk("cue ", number(1) + point(1, 8, 8)) + chunk("LIST", "adtl");
  const std::string before = wav(info + old, chunk("bext", "words") + old);
  test::writeText(folder_ / "a.wav", before);
  const auto labels = written({label(0.1, 0.1, "c1"), label(0.2, 0.25, "c2 terminal")});
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[1].text, "c2 terminal");
  const std::string after = test::readText(folder_ / "b.wav");
  EXPECT_EQ(littleEndian(after, 4, 4), after.size() - 8);
  const std::string head = "data" + number(8000);
  ASSERT_NE(before.find(head), std::string::npos);
  EXPECT_EQ(after.find(head), before.find(head)) << "the samples have not moved";
  EXPECT_TRUE(after.substr(after.find(head), 8008) == before.substr(before.find(head), 8008));
  EXPECT_NE(after.find("words"), std::string::npos);
  EXPECT_NE(after.find("hello"), std::string::npos);
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.wav", "b.wav"}));
}

TEST_F(WritesCues, OtherProgramsFindThem) {
  test::writeClicks(folder_ / "a.wav", {{0.1, 0.9}}, 0.5);
  ASSERT_EQ(written({label(0.1, 0.1, "c1"), label(0.3, 0.4, "c2")}).size(), 2U);
  SF_INFO info{};
  SNDFILE* file = sf_open((folder_ / "b.wav").c_str(), SFM_READ, &info);
  ASSERT_NE(file, nullptr);
  SF_CUES cues{};
  ASSERT_EQ(sf_command(file, SFC_GET_CUE, &cues, sizeof cues), SF_TRUE);
  sf_close(file);
  ASSERT_EQ(cues.cue_count, 2U);
  EXPECT_EQ(cues.cue_points[0].sample_offset, 4410U);
  EXPECT_EQ(cues.cue_points[1].sample_offset, 13230U);
}

TEST_F(WritesCues, APointThatSomebodyMovedIsWhereItWasMovedTo) {
  test::writeText(folder_ / "a.wav", wav(""));
  ASSERT_EQ(written({label(0.10003, 0.10003, "c1")}).size(), 1U);
  EXPECT_EQ(readWavCues(folder_ / "b.wav")->front().start, 0.10003);
  std::string bytes = test::readText(folder_ / "b.wav");
  const std::size_t cue = bytes.find("cue ");
  for (const std::size_t at : {cue + 16, cue + 32}) {
    ASSERT_EQ(littleEndian(bytes, at, 4), 800U);
    bytes.replace(at, 4, number(808));
  }
  test::writeText(folder_ / "b.wav", bytes);
  EXPECT_EQ(readWavCues(folder_ / "b.wav")->front().start, 0.101);
}

TEST_F(WritesCues, WhatIsNoWholeWavIsWrittenAnew) {
  const std::string whole = wav("");
  test::writeText(folder_ / "a.wav", whole.substr(0, whole.size() - 1000));
  EXPECT_EQ(written({label(0.1, 0.1, "c1")}).size(), 1U);
  EXPECT_EQ(readSound(folder_ / "b.wav")->samples, readSound(folder_ / "a.wav")->samples);
}

TEST_F(WritesCues, LeavesNothingWhereItCannotWrite) {
  test::writeText(folder_ / "a.wav", wav(""));
  const auto sound = readSound(folder_ / "a.wav");
  const auto good = writeWavWithCues(folder_ / "none" / "b.wav", folder_ / "a.wav", *sound,
                                     {label(0.1, 0.1, "c1")});
  ASSERT_FALSE(good);
  EXPECT_EQ(good.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(good.error().place, (folder_ / "none" / "b.wav").string());
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.wav"});
}

}  // namespace
}  // namespace ifa
