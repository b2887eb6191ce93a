// SPDX-License-Identifier: Apache-2.0
#include "pipeline/settings_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace ifa {
namespace {

TEST(SettingsHash, TellsEveryChangeThatShowsInAMotion) {
  using Change = std::function<void(SynchronizeSettings&, OutputSettings&)>;
  const std::vector<Change> changes = {
      [](auto&, auto&) {},
      [](auto& settings, auto&) { settings.labels = "marks.txt"; },
      [](auto& settings, auto&) { settings.ignoreCues = true; },
      [](auto& settings, auto&) { settings.midi.track = 2; },
      [](auto& settings, auto&) { settings.midi.channel = 2; },
      [](auto& settings, auto&) { settings.midi.durations = true; },
      [](auto& settings, auto&) { settings.terminal = true; },
      [](auto& settings, auto&) { settings.terminal = false; },
      [](auto& settings, auto&) { settings.object = "d6"; },
      [](auto& settings, auto&) { settings.surface = "wood"; },
      [](auto& settings, auto&) { settings.restitution = 0.0; },
      [](auto& settings, auto&) { settings.restitutionScale = 0.7; },
      [](auto& settings, auto&) { settings.fit = true; },
      [](auto& settings, auto&) { settings.planner = "shoot"; },
      [](auto& settings, auto&) { settings.seed = 2; },
      [](auto& settings, auto&) { settings.takes = 2; },
      [](auto& settings, auto&) { settings.timeLimitSeconds = 2; },
      [](auto& settings, auto&) { settings.energyGain = 0.1; },
      [](auto& settings, auto&) { settings.preRollSeconds = 0.1; },
      [](auto& settings, auto&) { settings.graph.database = "d6.ifdb"; },
      [](auto& settings, auto&) { settings.graph.simulations = 5; },
      [](auto& settings, auto&) { settings.graph.cut = EventCut::kPaper; },
      [](auto& settings, auto&) { settings.graph.symmetry = false; },
      [](auto& settings, auto&) {
        settings.orientations = {{0, "6", {0, 0, 1}, {0, 0, 1}}};
      },
      [](auto& settings, auto&) {
        settings.orientations = {{1, "6", {0, 0, 1}, {0, 0, 1}}};
      },
      [](auto& settings, auto&) {
        settings.orientations = {{1, "6", {0, 0, 1}, {0, 0, -1}}};
      },
      [](auto& settings, auto&) {
        settings.positions = {{1, {0, 0}}};
      },
      [](auto& settings, auto&) {
        settings.positions = {{1, {0, 0.1}}};
      },
      [](auto&, auto& output) { output.film.framesPerSecond = 24; },
      [](auto&, auto& output) { output.film.camera = CameraKind::kLow; },
      [](auto&, auto& output) { output.glbSet = true; },
  };
  std::set<std::string> hashes;
  for (const Change& change : changes) {
    SynchronizeSettings settings;
    OutputSettings output;
    change(settings, output);

    const std::string hash = hashOf(settings, output);
    EXPECT_EQ(hash.size(), 16U);
    hashes.insert(hash);
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(SettingsHash, DoesNotLookAtWhereTheSoundLies) {
  SynchronizeSettings here, there;
  here.sound = "a.wav";
  there.sound = "/tmp/a.wav";
  EXPECT_EQ(hashOf(here, {}), hashOf(there, {}));
}

}  // namespace
}  // namespace ifa
