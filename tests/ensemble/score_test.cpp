// SPDX-License-Identifier: Apache-2.0
#include "ensemble/score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ifa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A score with one part of which more is said.
std::string scoreText(const std::string& part, const std::string& heading = {}) {
  return R"({"format": "inverse-foley-score", "version": 1, "midi": "a.mid", )" + heading +
         R"("parts": [{"name": "hat", "object": "d6")" + part + "}]}";
}

std::string complaint(const std::string& text) {
  const auto score = parseScore(text, "songs/a.json");
  if (score) return "";
  EXPECT_EQ(score.error().code, ErrorCode::kBadInput);
  return score.error().text();
}

TEST(ParseScore, TakesEveryField) {
  const auto score = parseScore(
      scoreText(R"(, "surface": "desk", "sound": "glass", "colour": [0.1, 0.2, 1], "track": 2,
        "channel": 10, "notes": [42, 44], "bodies": 3, "deal": "turns", "restitution": 0.5,
        "energy_gain": 2, "ending": "bounce")",
                R"("seed": 7, "clearance": 0.01, )"),
      "songs/a.json");
  ASSERT_TRUE(score) << score.error().text();
  EXPECT_EQ(score->midi, "songs/a.mid");
  EXPECT_EQ(score->seed, 7U);
  EXPECT_EQ(score->clearance, 0.01);
  const ScorePart& part = score->parts.at(0);
  EXPECT_EQ(part.name, "hat");
  EXPECT_EQ(part.object, "d6");
  EXPECT_EQ(part.surface, "desk");
  EXPECT_EQ(part.sound, "glass");
  EXPECT_THAT(*part.colour, ElementsAre(0.1, 0.2, 1));
  EXPECT_EQ(part.track, 2);
  EXPECT_EQ(part.channel, 10);
  EXPECT_THAT(part.keys, ElementsAre(42, 44));
  EXPECT_EQ(part.bodies, 3);
  EXPECT_EQ(part.deal, Deal::kTurns);
  EXPECT_EQ(part.restitution, 0.5);
  EXPECT_EQ(part.energyGain, 2);
  EXPECT_FALSE(part.rests);
}

TEST(ParseScore, NeedsLittle) {
  const auto score = parseScore(scoreText(""), "a.json");
  ASSERT_TRUE(score) << score.error().text();
  EXPECT_EQ(score->parts.at(0).bodies, 1);
  EXPECT_EQ(score->parts.at(0).deal, Deal::kPhrases);
  EXPECT_TRUE(score->parts.at(0).rests);
  EXPECT_FALSE(score->parts.at(0).colour);
}

TEST(ParseScore, NamesTheFieldThatIsWrong) {
  EXPECT_THAT(complaint("{"), HasSubstr("not valid JSON"));
  EXPECT_THAT(complaint("[]"), HasSubstr("not valid JSON"));
  EXPECT_THAT(complaint(R"({"format": "inverse-foley-object"})"), HasSubstr("a.json: format"));
  EXPECT_THAT(complaint(scoreText("", R"("tempo": 3, )")), HasSubstr("tempo: is not known"));
  EXPECT_THAT(complaint(scoreText(R"(, "bodys": 3)")), HasSubstr("parts[0].bodys: is not known"));
  EXPECT_THAT(complaint(scoreText(R"(, "bodies": 0)")), HasSubstr("parts[0].bodies"));
  EXPECT_THAT(complaint(scoreText(R"(, "bodies": 2.5)")), HasSubstr("not a whole number"));
  EXPECT_THAT(complaint(scoreText(R"(, "bodies": 65)")), HasSubstr("parts[0].bodies"));
  EXPECT_THAT(complaint(scoreText(R"(, "channel": 17)")), HasSubstr("parts[0].channel"));
  EXPECT_THAT(complaint(scoreText(R"(, "notes": [128])")), HasSubstr("0 to 127"));
  EXPECT_THAT(complaint(scoreText(R"(, "notes": [])")), HasSubstr("parts[0].notes"));
  EXPECT_THAT(complaint(scoreText(R"(, "notes": 42)")), HasSubstr("parts[0].notes"));
  EXPECT_THAT(complaint(scoreText(R"(, "colour": [1, 2, 3])")), HasSubstr("parts[0].colour"));
  EXPECT_THAT(complaint(scoreText(R"(, "colour": "red")")), HasSubstr("parts[0].colour"));
  EXPECT_THAT(complaint(scoreText(R"(, "deal": "cards")")), HasSubstr("phrases, turns"));
  EXPECT_THAT(complaint(scoreText(R"(, "ending": "fade")")), HasSubstr("rest, bounce"));
  EXPECT_THAT(complaint(scoreText(R"(, "restitution": 1)")), HasSubstr("parts[0].restitution"));
  EXPECT_THAT(complaint(scoreText(R"(, "energy_gain": "much")")), HasSubstr("energy_gain"));
  EXPECT_THAT(complaint(scoreText(R"(}, {"name": "hat", "object": "d6")")),
              HasSubstr("parts[1].name: is that of another part"));
  EXPECT_THAT(complaint(scoreText(R"(}, {"name": "../x", "object": "d6")")),
              HasSubstr("parts[1].name"));
  EXPECT_THAT(complaint(scoreText(R"(}, {"name": "x")")), HasSubstr("parts[1].object: is missing"));
  EXPECT_THAT(complaint(R"({"format": "inverse-foley-score", "version": 1, "midi": "a.mid",
                            "parts": []})"),
              HasSubstr("parts"));
}

TEST(ScoreOfNotes, EachChannelOfEachTrackIsAPart) {
  std::vector<ScoreNote> notes(4);
  notes[1].channel = 3;
  notes[2].track = 2;
  notes[3].channel = 3;
  const Score score = scoreOfNotes("a.mid", notes, "d6");
  ASSERT_EQ(score.parts.size(), 3U);
  EXPECT_EQ(score.parts[0].name, "track-1-channel-1");
  EXPECT_EQ(score.parts[1].name, "track-1-channel-3");
  EXPECT_EQ(score.parts[2].name, "track-2-channel-1");
  EXPECT_EQ(score.parts[2].object, "d6");
  EXPECT_NE(*score.parts[0].colour, *score.parts[1].colour);
  EXPECT_FALSE(scoreOfNotes("a.mid", {notes[0]}, "d6").parts.at(0).colour) << "one needs none";
}

}  // namespace
}  // namespace ifa
