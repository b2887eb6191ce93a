// SPDX-License-Identifier: Apache-2.0
#include "ensemble/voices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ifa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<ScoreNote> notesAt(const std::vector<double>& times, int key = 60) {
  std::vector<ScoreNote> notes;
  for (const double time : times) notes.push_back({time, 1, 1, key, 0.5});
  return notes;
}

Score scoreOf(int bodies, Deal deal = Deal::kPhrases) {
  Score score;
  score.parts.resize(1);
  score.parts[0].name = "hat";
  score.parts[0].bodies = bodies;
  score.parts[0].deal = deal;
  return score;
}

std::vector<double> timesOf(const Voice& voice) {
  std::vector<double> times;
  for (const ScoreNote& note : voice.notes) times.push_back(note.time);
  return times;
}

std::vector<Voice> dealt(const Score& score, const std::vector<ScoreNote>& notes) {
  auto voices = dealVoices(score, notes, "a.mid");
  EXPECT_TRUE(voices) << voices.error().text();
  return voices.value_or(std::vector<Voice>());
}

std::string complaint(const Score& score, const std::vector<ScoreNote>& notes) {
  const auto voices = dealVoices(score, notes, "a.mid");
  return voices ? "" : voices.error().text();
}

TEST(DealVoices, InPhrasesAndInTurns) {
  const auto notes = notesAt({0, 0.1, 0.2, 0.3, 0.4});
  const auto phrases = dealt(scoreOf(2), notes);
  ASSERT_EQ(phrases.size(), 2U);
  EXPECT_EQ(phrases[0].name, "hat-1");
  EXPECT_EQ(phrases[1].name, "hat-2");
  EXPECT_THAT(timesOf(phrases[0]), ElementsAre(0, 0.1, 0.2));
  EXPECT_THAT(timesOf(phrases[1]), ElementsAre(0.3, 0.4));
  const auto turns = dealt(scoreOf(2, Deal::kTurns), notes);
  EXPECT_THAT(timesOf(turns.at(0)), ElementsAre(0, 0.2, 0.4));
  EXPECT_THAT(timesOf(turns.at(1)), ElementsAre(0.1, 0.3));
  EXPECT_EQ(dealt(scoreOf(1), notes).at(0).name, "hat");
  EXPECT_EQ(dealt(scoreOf(9), notes).size(), 5U) << "no body is without a note";
}

TEST(DealVoices, NotesTogetherAreOneContactAsLoudAsTheLoudest) {
  auto notes = notesAt({0, 0.004, 0.3});
  notes[1].velocity = 0.9;
  const auto voices = dealt(scoreOf(1), notes);
  EXPECT_THAT(timesOf(voices.at(0)), ElementsAre(0, 0.3));
  EXPECT_EQ(voices[0].notes[0].velocity, 0.9);
}

TEST(DealVoices, PartsTakeTheirOwnNotes) {
  auto notes = notesAt({0, 0.2}, 36);
  notes.push_back({0.3, 2, 10, 42, 1});
  Score score = scoreOf(1);
  score.parts[0].keys = {36};
  score.parts.push_back(score.parts[0]);
  score.parts[1].name = "other";
  score.parts[1].keys = {};
  score.parts[1].track = 2;
  const auto voices = dealt(score, notes);
  ASSERT_EQ(voices.size(), 2U);
  EXPECT_THAT(timesOf(voices[0]), ElementsAre(0, 0.2));
  EXPECT_THAT(timesOf(voices[1]), ElementsAre(0.3));
  EXPECT_EQ(voices[1].part, 1U);
}

TEST(DealVoices, AnotherBodyTakesOverAfterALongPause) {
  const auto voices = dealt(scoreOf(1), notesAt({0, 0.6, 1.4, 1.8}));
  ASSERT_EQ(voices.size(), 2U);
  EXPECT_THAT(timesOf(voices[0]), ElementsAre(0, 0.6));
  EXPECT_THAT(timesOf(voices[1]), ElementsAre(1.4, 1.8));
}

TEST(DealVoices, TellsHowManyBodiesPlayWhatIsTooFastForOne) {
  std::vector<double> roll;
  for (int i = 0; i < 30; ++i) roll.push_back(0.015 * i);
  EXPECT_THAT(complaint(scoreOf(2), notesAt(roll)),
              AllOf(HasSubstr("part \"hat\""), HasSubstr("0.000 and 0.015 s"),
                    HasSubstr("\"bodies\": 3, \"deal\": \"turns\"")));
  EXPECT_EQ(dealt(scoreOf(3, Deal::kTurns), notesAt(roll)).size(), 3U) << "the remedy helps";
}

TEST(DealVoices, TellsWhichNotesThereAre) {
  Score score = scoreOf(1);
  score.parts[0].channel = 4;
  EXPECT_THAT(complaint(score, notesAt({0, 1})), AllOf(HasSubstr("no notes for part \"hat\""),
                                                       HasSubstr("track 1 channel 1 note 60")));
}

TEST(DealVoices, RefusesMoreBodiesThanThereMayBeAndNamesTwice) {
  std::vector<double> rare;
  for (int i = 0; i < 65; ++i) rare.push_back(i);
  EXPECT_THAT(complaint(scoreOf(1), notesAt(rare)), HasSubstr("65 bodies"));
  Score score = scoreOf(2);
  score.parts.push_back(score.parts[0]);
  score.parts[1].name = "hat-1";
  score.parts[1].bodies = 1;
  EXPECT_THAT(complaint(score, notesAt({0, 0.2})), HasSubstr("hat-1"));
}

TEST(SignatureOf, BeginsWithTheFirstNoteInTheCommonTime) {
  Voice voice{"hat", 0, notesAt({1.5, 1.75})};
  voice.notes[1].velocity = 0.25;
  const ContactSignature signature = signatureOf(voice, false, 0.5);
  EXPECT_EQ(signature.firstContact, 2);
  ASSERT_EQ(signature.events.size(), 2U);
  EXPECT_EQ(signature.events[1].time, 0.25);
  EXPECT_EQ(signature.events[1].amplitude, 0.5);
  EXPECT_FALSE(signature.terminal);
}

}  // namespace
}  // namespace ifa
