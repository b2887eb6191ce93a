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

constexpr const char* kTwoDice =
    R"([{"name": "high", "object": "d6", "notes": [42], "colour": [0.1, 0.3, 0.9],
         "sound": "glass"}, {"name": "low", "object": "d6", "notes": [36]}])";

Result<EnsembleResult> perform(EnsembleSettings settings, const std::filesystem::path& folder) {
  OutputSettings output;
  output.formats = {OutputFormat::kJson, OutputFormat::kGlb};
  return performToFolder(settings, folder, output);
}

/// Where the tune and scores for it are.
struct Desk {
  Desk() { test::writeText(folder / "tune.mid", tune()); }
  [[nodiscard]] EnsembleSettings score(const std::string& parts) const {
    EnsembleSettings settings;
    settings.score = folder / "tune.json";
    test::writeText(settings.score,
                    R"({"format": "inverse-foley-score", "version": 1, "midi": "tune.mid",
                        "parts": )" +
                        parts + "}");
    return settings;
  }
  test::TemporaryFolder folder;
};

/// Played once for all that looks at what is written.
class Perform : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(result_) << result_.error().text(); }
  [[nodiscard]] std::filesystem::path out() const { return desk_.folder / "out"; }
  void expectNotesApart();
  void expectSoundOnNotesAlone();
  void expectOneAnimation();
  void expectTheSameAgain();

  Desk desk_;
  Result<EnsembleResult> result_ = perform(desk_.score(kTwoDice), out());
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

void Perform::expectNotesApart() {
  const auto& result = result_;
  ASSERT_EQ(result->failed(), nullptr) << result->failed()->motion.failure;
  EXPECT_LT(result->worstContact, 1e-4);
  ASSERT_TRUE(result->leastDistance);
  EXPECT_GE(*result->leastDistance, 0.008 - 1e-4) << "half of a die";

  const auto read = readEnsembleFolder(out());
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

void Perform::expectSoundOnNotesAlone() {
  const auto sound = readSound(out() / "sound.wav");
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
  const auto voice = readSound(out() / "bodies/high/sound.wav");
  ASSERT_TRUE(voice);
  EXPECT_EQ(voice->samples.size(), readSound(out() / "bodies/low/sound.wav")->samples.size());
}

void Perform::expectOneAnimation() {
  const std::string glb = test::readText(out() / "ensemble.glb");
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

void Perform::expectTheSameAgain() {
  const auto again = desk_.folder / "again";
  ASSERT_TRUE(perform(desk_.score(kTwoDice), again));
  for (const char* name : {"ensemble.json", "sound.wav", "ensemble.glb", "bodies/low/sound.wav"}) {
    EXPECT_EQ(test::readText(out() / name), test::readText(again / name)) << name;
  }
}

TEST_F(Perform, SlowlyPlaysAScoreFromFileToFiles) {
  expectNotesApart();
  expectSoundOnNotesAlone();
  expectOneAnimation();
  expectTheSameAgain();
}

TEST(PerformErrors, AreToldBeforeAnythingIsPlanned) {
  const Desk desk;
  const auto complaint = [&](const EnsembleSettings& settings) -> std::string {
    const auto result = perform(settings, desk.folder / "out");
    EXPECT_FALSE(std::filesystem::exists(desk.folder / "out")) << "no trace is left";
    return result ? "" : result.error().text();
  };
  const auto part = [&](const std::string& more) {
    return desk.score(R"([{"name": "a", "notes": [42], )" + more + "}]");
  };
  EXPECT_THAT(complaint(part(R"("object": "teapot")")), HasSubstr("teapot"));
  EXPECT_THAT(complaint(part(R"("object": "d6", "surface": "lava")")), HasSubstr("lava"));
  EXPECT_THAT(complaint(part(R"("object": "d6", "sound": "jelly")")),
              AllOf(HasSubstr("jelly"), HasSubstr("part \"a\"")));
  EXPECT_THAT(complaint(desk.score(R"([{"name": "a", "object": "d6"}])")),
              HasSubstr("too close for one body"));
  EXPECT_THAT(complaint(desk.score(R"([{"name": "a", "object": "d6", "notes": [99]}])")),
              HasSubstr("no notes for part"));
  EnsembleSettings settings = part(R"("object": "d6")");
  settings.object = "d6";
  EXPECT_THAT(complaint(settings), HasSubstr("--object")) << "a score names its own";
  settings.score = desk.folder / "tune.mid";
  settings.object.clear();
  EXPECT_THAT(complaint(settings), HasSubstr("--object")) << "a MIDI file names none";
  settings = part(R"("object": "d6")");
  settings.planner = "graph";
  EXPECT_THAT(complaint(settings), HasSubstr("--planner"));
}

}  // namespace
}  // namespace ifa
