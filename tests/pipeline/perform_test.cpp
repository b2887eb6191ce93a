// SPDX-License-Identifier: Apache-2.0
// Two dice that play a score of their own, from the MIDI file to the files of the ensemble.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "audit/audit.h"
#include "ifa/ensemble.h"
#include "pipeline/ensemble_folder.h"
#include "sound/sound.h"
#include "support/midi_bytes.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::noteOff;
using test::noteOn;
using testing::HasSubstr;

// 120 beats a minute, 100 ticks a beat: 5 ms a tick. High notes at 0, 160 and 320 ms, low ones from
// 200 ms on.
std::string tune() {
  return test::midiFile(1, 100,
                        {noteOn(0, 42, 100) + noteOff(10, 42) + noteOn(22, 42, 90) +
                             noteOff(10, 42) + noteOn(22, 42, 80) + noteOff(10, 42),
                         noteOn(40, 36, 110) + noteOff(10, 36) + noteOn(20, 36, 100) +
                             noteOff(10, 36) + noteOn(20, 36, 90)});
}

class Perform : public testing::Test {
 protected:
  void SetUp() override {
    test::writeText(folder_ / "tune.mid", tune());
    settings_.score = folder_ / "tune.json";
    writeScore(R"([{"name": "high", "object": "d6", "notes": [42], "colour": [0.1, 0.3, 0.9],
                    "sound": "glass"}, {"name": "low", "object": "d6", "notes": [36]}])");
    output_.formats = {OutputFormat::kJson, OutputFormat::kGlb};
  }
  void writeScore(const std::string& parts) const {
    test::writeText(settings_.score,
                    R"({"format": "inverse-foley-score", "version": 1, "midi": "tune.mid",
                        "parts": )" +
                        parts + "}");
  }
  [[nodiscard]] Result<EnsembleResult> perform() const {
    return performToFolder(settings_, folder_ / "out", output_);
  }
  [[nodiscard]] std::string complaint() const {
    const auto result = perform();
    if (result) return "";
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << "no trace is left";
    return result.error().text();
  }

  test::TemporaryFolder folder_;
  EnsembleSettings settings_;
  OutputSettings output_;
};

void expectMotionOnItsNotes(const MotionFolder& body, const FloorPlace& place,
                            const std::vector<double>& notes) {
  const Motion& motion = body.motion;
  ASSERT_TRUE(motion.success) << motion.failure;
  ASSERT_EQ(motion.contacts.size(), notes.size());
  for (std::size_t i = 0; i < notes.size(); ++i) {
    // Half a second of silence comes first, in which the bodies fall in.
    EXPECT_NEAR(motion.contacts[i].time + motion.sound.firstContact, 0.5 + notes[i], 1e-4);
  }
  EXPECT_TRUE(motion.contacts.back().terminal) << "it rests on its last note";
  EXPECT_TRUE(audit(motion, body.body).passed());
  EXPECT_TRUE(audit(place.apply(motion), body.body).passed()) << "where it is laid, too";
}

TEST_F(Perform, TwoDicePlayTheirNotesApart) {
  const auto result = perform();
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->failed(), nullptr) << result->failed()->motion.failure;
  EXPECT_LT(result->worstContact, 1e-4);
  ASSERT_TRUE(result->leastDistance);
  EXPECT_GE(*result->leastDistance, 0.008 - 1e-4) << "half of a die";

  const auto read = readEnsembleFolder(folder_ / "out");
  ASSERT_TRUE(read) << read.error().text();
  ASSERT_EQ(read->bodies.size(), 2U);
  EXPECT_EQ(read->ensemble.bodies[0].name, "high");
  expectMotionOnItsNotes(read->bodies[0], read->ensemble.bodies[0].place, {0, 0.16, 0.32});
  expectMotionOnItsNotes(read->bodies[1], read->ensemble.bodies[1].place, {0.2, 0.35, 0.5});
  const Separation again = leastSeparation(laidMotions(*read));
  EXPECT_EQ(again.least, *result->leastDistance) << "the files say what was told";

  // The blue die is blue in its own folder, its pips are not; the other one is as in the library.
  const auto mostBlue = [&](std::size_t i) {
    double most = -1;
    for (const MeshMaterial& material : read->bodies[i].body.mesh.materials) {
      most = std::max(most, material.colour[2] - material.colour[0]);
    }
    return most;
  };
  EXPECT_GT(mostBlue(0), 0.5);
  EXPECT_LT(mostBlue(1), 0.05);
}

TEST_F(Perform, SoundsOnEveryNoteAndOnNothingElse) {
  ASSERT_TRUE(perform());
  const auto sound = readSound(folder_ / "out" / "sound.wav");
  ASSERT_TRUE(sound) << sound.error().text();
  const auto energy = [&](double from, double to) {
    double sum = 0;
    for (auto i = static_cast<std::size_t>(from * sound->rate);
         i < static_cast<std::size_t>(to * sound->rate); ++i) {
      sum += sound->samples.at(i) * sound->samples.at(i);
    }
    return sum / (to - from);
  };
  for (const double note : {0.0, 0.16, 0.2, 0.32, 0.35, 0.5}) {
    const double at = 0.5 + note;
    EXPECT_GT(energy(at, at + 0.005), 5 * energy(at - 0.006, at - 0.001)) << note;
  }
  EXPECT_EQ(energy(0, 0.49), 0);
  const auto voice = readSound(folder_ / "out/bodies/high/sound.wav");
  ASSERT_TRUE(voice);
  EXPECT_EQ(voice->samples.size(), readSound(folder_ / "out/bodies/low/sound.wav")->samples.size());
}

TEST_F(Perform, OneAnimationMovesAllBodies) {
  ASSERT_TRUE(perform());
  const std::string glb = test::readText(folder_ / "out" / "ensemble.glb");
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const auto json = nlohmann::json::parse(glb.substr(20, length));
  ASSERT_EQ(json["nodes"].size(), 2U);
  EXPECT_EQ(json["nodes"][0]["name"], "high");
  EXPECT_EQ(json["nodes"][1]["mesh"], 1);
  EXPECT_NE(json["meshes"][0]["primitives"][0]["material"],
            json["meshes"][1]["primitives"][0]["material"]);
  ASSERT_EQ(json["animations"].size(), 1U);
  int moved = 0, entrances = 0;
  for (const auto& channel : json["animations"][0]["channels"]) {
    const auto& sampler = json["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
    if (channel["target"]["path"] == "translation")
      moved += 1 + channel["target"]["node"].get<int>();
    if (channel["target"]["path"] != "scale") continue;
    EXPECT_EQ(sampler["interpolation"], "STEP");
    ++entrances;
  }
  EXPECT_EQ(moved, 1 + 2) << "each once";
  EXPECT_GE(entrances, 1) << "the second one is not there before it falls in";
}

TEST_F(Perform, IsTheSameForTheSameSeed) {
  ASSERT_TRUE(perform());
  const std::string ensemble = test::readText(folder_ / "out/ensemble.json");
  const std::string sound = test::readText(folder_ / "out/sound.wav");
  ASSERT_TRUE(perform());
  EXPECT_EQ(test::readText(folder_ / "out/ensemble.json"), ensemble);
  EXPECT_EQ(test::readText(folder_ / "out/sound.wav"), sound);
}

TEST_F(Perform, TellsWhatCannotBePlayedBeforeItPlans) {
  writeScore(R"([{"name": "a", "object": "teapot"}])");
  EXPECT_THAT(complaint(), HasSubstr("teapot"));
  writeScore(R"([{"name": "a", "object": "d6", "surface": "lava"}])");
  EXPECT_THAT(complaint(), HasSubstr("lava"));
  writeScore(R"([{"name": "a", "object": "d6", "sound": "jelly"}])");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("jelly"), HasSubstr("part \"a\"")));
  writeScore(R"([{"name": "a", "object": "d6", "notes": [99]}])");
  EXPECT_THAT(complaint(), HasSubstr("no notes for part"));
  settings_.object = "d6";
  EXPECT_THAT(complaint(), HasSubstr("--object"));
  settings_.score = folder_ / "tune.mid";
  settings_.object.clear();
  EXPECT_THAT(complaint(), HasSubstr("--object"));
  settings_.object = "d6";
  settings_.planner = "graph";
  EXPECT_THAT(complaint(), HasSubstr("--planner"));
}

}  // namespace
}  // namespace ifa
