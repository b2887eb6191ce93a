// SPDX-License-Identifier: Apache-2.0
// Makes sounds whose contacts are known, for scripts/evaluate_detection.py: of motions, and of
// drops that ODE simulated; with a room and noise (docs/detection.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "body/object_file.h"
#include "export/motion_json.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"
#include "sampler/paper_rows.h"
#include "sampler/simulator_comparison.h"
#include "signature/labels.h"
#include "sonify/room.h"
#include "sonify/sonify.h"
#include "sound/band_energy.h"

namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<fs::path> motions;
  fs::path folder;
  std::size_t drops = 0;
  std::uint64_t seed = 2014;
  double reverberation = 0.4;  // s
  double noise = 20;           // dB under the sound
};

/// What is to be heard, times in s of the sound.
struct Score {
  std::string name;
  ifa::Body body;
  std::vector<ifa::Strike> strikes;
  std::vector<ifa::Label> events;
  double lead = 0.3;  // s of what the noise is alone
};

/// Materials of drops: every object sounds as itself, then as others.
std::string materialOf(const ifa::Body& body, std::size_t index) {
  constexpr const char* kOthers[] = {"wood", "steel", "glass", "ABS", "ceramic", "stone"};
  return index % 2 == 0 ? body.definition.material : kOthers[index / 2 % std::size(kOthers)];
}

/// The part of a sound between two times, s.
ifa::Sound part(const ifa::Sound& sound, double from, double to) {
  ifa::Sound piece;
  piece.rate = sound.rate;
  const auto at = [&](double time) {
    return std::min(sound.samples.size(),
                    static_cast<std::size_t>(std::max(0.0, time) * sound.rate));
  };
  piece.samples.assign(sound.samples.begin() + static_cast<std::ptrdiff_t>(at(from)),
                       sound.samples.begin() + static_cast<std::ptrdiff_t>(at(to)));
  return piece;
}

ifa::Label labelled(double start, double end, const char* text) {
  ifa::Label label;
  label.start = start;
  label.end = end;
  label.text = text;
  return label;
}

/// Whether a contact's own sound is in its first 5 ms, in some band, 6 dB above all else that is
/// there: the noise, the room, and what still rings. The ear asks for more: what lasts for 5 ms
/// must be about 16 dB above the threshold of what lasts (Plomp and Bouman 1959).
bool standsOut(const ifa::StruckBody& struck, const std::vector<ifa::Strike>& placed,
               const ifa::Sound& whole, const ifa::Label& event) {
  constexpr double kBefore = 0.02, kWindow = 0.005, kStandsOut = 4;
  // On a sample, so that what is taken away fits.
  const double from = std::floor((event.start - kBefore) * whole.rate) / whole.rate;
  std::vector<ifa::Strike> own;
  for (ifa::Strike strike : placed) {
    if (strike.time < event.start - 5e-4 || strike.time > std::max(event.end, event.start) + 5e-4)
      continue;
    strike.time -= from;
    own.push_back(strike);
  }
  const ifa::Sound all = part(whole, from, event.start + kWindow);
  ifa::Sound mine = struck.hit(own, kBefore + kWindow);
  mine.samples.resize(all.samples.size(), 0.0F);
  ifa::Sound rest = all;
  for (std::size_t i = 0; i < rest.samples.size(); ++i) rest.samples[i] -= mine.samples[i];
  const auto a = ifa::bandEnergies(mine), b = ifa::bandEnergies(rest);
  const auto first = a.hopsIn(kBefore), last = first + a.hopsIn(kWindow);
  for (std::size_t i = 0; i < a.bands.size(); ++i) {
    if (a.bands[i].mean(first, last) > kStandsOut * b.bands[i].mean(first, last)) return true;
  }
  return false;
}

/// Adds a label "blow" for every run of blows, audible or not, down to a tenth of what is audible:
/// whoever hears one of these hears nothing wrong.
void addBlows(const std::vector<ifa::Strike>& placed, Score& score) {
  const auto& definition = score.body.definition;
  const double reference = definition.surfaces.at(definition.defaultSurface).referenceImpulse;
  std::vector<ifa::Label> blows;
  for (const ifa::Strike& strike : placed) {
    if (strike.impulse < 0.1 * ifa::kAudibleShare * reference) continue;
    if (blows.empty() || strike.time - blows.back().end > definition.mergeGap) {
      blows.push_back(labelled(strike.time, strike.time, "blow"));
    }
    blows.back().end = strike.time;
  }
  score.events.insert(score.events.end(), blows.begin(), blows.end());
  std::stable_sort(score.events.begin(), score.events.end(),
                   [](const ifa::Label& a, const ifa::Label& b) { return a.start < b.start; });
}

ifa::Result<void> write(Score score, std::size_t index, const Options& options) {
  const std::uint64_t seed = options.seed + index;
  const auto& definition = score.body.definition;
  const auto material = ifa::findSoundMaterial(materialOf(score.body, index));
  if (!material) return tl::unexpected(material.error());
  ifa::SonifySettings settings;
  settings.material = *material;
  settings.floor = ifa::soundFloor(index % 3 == 0 ? "stone" : definition.defaultSurface);
  settings.seed = seed;
  const auto placed = ifa::placeStrikes(score.strikes, score.lead, seed);
  for (ifa::Label& event : score.events) event.start += score.lead, event.end += score.lead;
  const double duration = score.events.back().end + ifa::kSonifyTail;
  const ifa::StruckBody struck(score.body, settings);
  ifa::Sound sound = struck.hit(placed, duration);
  ifa::addReverberation(sound, options.reverberation, seed);
  ifa::addNoise(sound, options.noise, seed);
  for (ifa::Label& event : score.events) {
    if (!standsOut(struck, placed, sound, event)) event.text = "hidden " + event.text;
  }
  addBlows(placed, score);
  ifa::setPeak(sound);
  const auto base = options.folder / (score.name + "-" + material->name);
  if (const auto done = ifa::writeWav(base.string() + ".wav", sound); !done) return done;
  return ifa::writeLabels(base.string() + ".txt", score.events);
}

ifa::Result<Score> ofMotion(const fs::path& place) {
  const fs::path file = fs::is_directory(place) ? place / "motion.json" : place;
  const auto motion = ifa::readMotionJson(file);
  if (!motion) return tl::unexpected(motion.error());
  const auto body = ifa::loadObject(motion->object.name);
  if (!body) return tl::unexpected(body.error());
  Score score;
  score.name = "motion-" + file.parent_path().filename().string();
  score.body = *body;
  score.strikes = ifa::strikesOf(*motion, *body);
  for (const ifa::MotionContact& contact : motion->contacts) {
    score.events.push_back(
        labelled(contact.time, contact.end, contact.terminal ? "terminal" : "contact"));
  }
  return score;
}

/// A drop of `body` that comes to rest; none where number `index` does not.
std::vector<Score> ofDrop(const ifa::Body& body, std::size_t index, const Options& options) {
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  const auto start = ifa::sampleInitialState(body, options.seed, index);
  const auto drop = ifa::simulateDropOde(body, surface, start, 20, ifa::fineOde());
  const auto events = ifa::eventsOf(drop, ifa::audibleCut(body, surface));
  if (!drop.atRest || events.size() < 2) return {};
  Score score;
  score.name = fmt::format("drop-{}-{:03}", body.definition.name, index);
  score.body = body;
  score.strikes = ifa::strikesOf(drop.steps, body);
  for (const ifa::ContactEvent& event : events) {
    score.events.push_back(
        labelled(event.start, event.end, event.terminal ? "terminal" : "contact"));
  }
  return {score};
}

ifa::Result<void> run(const Options& options) {
  fs::create_directories(options.folder);
  std::size_t count = 0;
  for (const fs::path& motion : options.motions) {
    const auto score = ofMotion(motion);
    if (!score) return tl::unexpected(score.error());
    if (const auto done = write(*score, count++, options); !done) return done;
  }
  const auto& names = ifa::evaluationObjects();
  std::vector<ifa::Body> bodies;
  for (const std::string_view name : names) {
    const auto body = ifa::loadObject(std::string(name));
    if (!body) return tl::unexpected(body.error());
    bodies.push_back(*body);
  }
  for (std::size_t made = 0, i = 0; made < options.drops; ++i) {
    for (const Score& score : ofDrop(bodies[i % bodies.size()], i, options)) {
      if (const auto done = write(score, count++, options); !done) return done;
      ++made;
    }
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Makes sounds whose contacts are known"};
  Options options;
  app.add_option("MOTION", options.motions, "motion.json files or their folders");
  app.add_option("-o", options.folder, "folder to write in")->required();
  app.add_option("--drops", options.drops, "drops simulated by ODE");
  app.add_option("--seed", options.seed);
  app.add_option("--reverb", options.reverberation, "s in which the room's echo falls by 60 dB");
  app.add_option("--noise", options.noise, "dB of the sound over the noise");
  CLI11_PARSE(app, argc, argv);
  if (const auto done = run(options); !done) {
    fmt::print(stderr, "{}\n", done.error().text());
    return 3;
  }
  return 0;
}
