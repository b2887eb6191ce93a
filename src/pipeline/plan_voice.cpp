// SPDX-License-Identifier: Apache-2.0
#include "pipeline/plan_voice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "base/paths.h"
#include "base/stopwatch.h"
#include "pipeline/chosen_body.h"
#include "pipeline/learned.h"
#include "signature/signature_json.h"

namespace ifa {

namespace {

constexpr int kFreeTakes = 6;
constexpr double kDeader = 1.0 / 3;  // times the restitution
// From one contact to the next, in body sizes; tried in this order. On the spot is seen best, but
// steep jumps need the friction of a body that is under way.
constexpr std::array kHops = {1.25, 3.0, 6.25};

/// Side of the square of floor that a motion covers from its first contact on, m.
double coveredFloor(const Motion& motion) {
  Eigen::AlignedBox2d box;
  for (const MotionSample& sample : motion.trajectory) {
    if (sample.time >= 0) box.extend(Eigen::Vector2d(sample.position.head<2>()));
  }
  return box.isEmpty() ? 0 : box.sizes().norm();
}

std::vector<PositionWish> hops(std::size_t contacts, double length) {
  std::vector<PositionWish> wishes;
  for (std::size_t k = 0; k < contacts; ++k) {
    wishes.push_back({static_cast<int>(k) + 1, {length * static_cast<double>(k), 0}});
  }
  return wishes;
}

Result<Motion> hopping(SynchronizeSettings settings, std::size_t contacts, double length,
                       const Progress& progress) {
  settings.positions = hops(contacts, length);
  auto found = synchronize(settings, progress);
  if (!found) return tl::unexpected(found.error());
  return std::move(found->takes.front());
}

Result<Motion> free(SynchronizeSettings settings, const Progress& progress) {
  settings.takes = kFreeTakes;
  auto found = synchronize(settings, progress);
  if (!found) return tl::unexpected(found.error());
  auto& takes = found->takes;
  const auto worse = [](const Motion& a, const Motion& b) {
    return std::pair(!a.success, coveredFloor(a)) < std::pair(!b.success, coveredFloor(b));
  };
  return std::move(*std::min_element(takes.begin(), takes.end(), worse));
}

/// The first attempt that succeeds, else the last one.
Result<Motion> shortestHops(const SynchronizeSettings& settings, std::size_t contacts, double size,
                            const Progress& progress) {
  for (const double hop : kHops) {
    auto motion = hopping(settings, contacts, hop * size, progress);
    if (!motion || motion->success) return motion;
  }
  return free(settings, progress);
}

/// The surface's part in the object file beside the motion: its threshold of hearing is known now.
Result<Body> bodyAsUsed(const SynchronizeSettings& settings, const Progress& progress) {
  auto chosen = loadChosenBody(settings);
  if (!chosen) return tl::unexpected(chosen.error());
  auto& surface = chosen->body.definition.surfaces.at(chosen->surface);
  surface.referenceImpulse =
      learnObject(chosen->body, surface, cacheFolder(), progress).referenceImpulse;
  return std::move(chosen->body);
}

}  // namespace

SynchronizeSettings settingsOf(const ScorePart& part, std::uint64_t seed,
                               const std::string& planner) {
  SynchronizeSettings settings;
  settings.object = part.object;
  settings.surface = part.surface;
  settings.restitution = part.restitution;
  settings.energyGain = part.energyGain;
  settings.planner = planner;
  settings.seed = seed;
  settings.preRollSeconds = kEnsembleLead;
  return settings;
}

Result<PlannedVoice> planVoice(const Voice& voice, const ScorePart& part, std::uint64_t seed,
                               const std::string& planner, const std::filesystem::path& folder,
                               const Progress& progress) {
  const Stopwatch watch;
  SynchronizeSettings settings = settingsOf(part, seed, planner);
  settings.sound = folder / kNotesName;
  const auto notes = signatureOf(voice, part.rests, kEnsembleLead);
  if (auto written = writeSignature(settings.sound, notes); !written) {
    return tl::unexpected(written.error());
  }
  auto body = bodyAsUsed(settings, progress);
  if (!body) return tl::unexpected(body.error());
  auto motion = shortestHops(settings, notes.events.size(), body->size, progress);
  if (motion && !motion->success && part.rests) {
    // After a high jump only a floor that gives back next to nothing stops a body.
    SynchronizeSettings deader = settings;
    *deader.restitution *= kDeader;
    auto again = bodyAsUsed(deader, progress);
    if (!again) return tl::unexpected(again.error());
    auto other = shortestHops(deader, notes.events.size(), again->size, progress);
    if (!other || other->success) {
      motion = std::move(other);
      body = std::move(again);
    }
  }
  if (!motion) return tl::unexpected(motion.error());
  PlannedVoice planned{{voice.name, part.name, std::move(*motion), 0}, std::move(*body)};
  planned.player.search = watch.seconds();
  return planned;
}

}  // namespace ifa
