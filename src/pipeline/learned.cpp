// SPDX-License-Identifier: Apache-2.0
#include "pipeline/learned.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/file.h"
#include "base/hash.h"
#include "dynamics/simulator.h"
#include "planner/shooting_planner_settings.h"
#include "sampler/calibration.h"
#include "sampler/drop_statistics.h"

namespace ifa {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kMostBytes = 1 << 16;
constexpr std::size_t kImpulseDrops = 500;
constexpr int kRestitutionDrops = 1000;
constexpr int kRhythmDrops = 1000;

/// Everything that what is learnt depends on.
std::uint64_t keyOf(const Body& body, const SurfaceProperties& surface) {
  Hash hash;
  hash.add(std::uint64_t{kSimulationVersion}).add(kAudibleShare);
  hash.add(body.mass).add(body.definition.mergeGap);
  for (const Eigen::Vector3d& vertex : body.hull) {
    hash.add(vertex.x()).add(vertex.y()).add(vertex.z());
  }
  for (const double moment : body.principalMoments) hash.add(moment);
  for (const double entry : body.bodyFromPrincipal.reshaped()) hash.add(entry);
  const SamplingSettings& sampling = body.definition.sampling;
  hash.add(sampling.coneDegrees).add(sampling.speed[0]).add(sampling.speed[1]);
  hash.add(sampling.spin[0]).add(sampling.spin[1]);
  hash.add(surface.restitution).add(surface.friction).add(surface.rollingFriction);
  hash.add(surface.spinningFriction).add(surface.referenceImpulse);
  return hash.value();
}

/// What `take` makes of the file's content; nothing when it was learnt of something else.
template <class Take>
auto read(const fs::path& file, std::uint64_t key, const Take& take)
    -> std::optional<decltype(take(Json()))> {
  const auto text = readFile(file, kMostBytes);
  if (!text) return {};
  const Json json = Json::parse(*text, nullptr, false);
  try {
    if (json.at("key") != key) return {};
    return take(json);
  } catch (const Json::exception&) {
    return {};
  }
}

Learned learnedFrom(const Json& json) {
  const EnergyOutlook::Coefficients coefficients = {
      json.at("weights").get<std::array<double, EnergyOutlook::kFeatures>>(), json.at("spread"),
      json.at("rest_energy")};
  return {json.at("reference_impulse"), EnergyOutlook(coefficients)};
}

RestitutionOutlook restitutionFrom(const Json& json) {
  return RestitutionOutlook(
      {json.at("weights").get<std::array<double, RestitutionOutlook::kFeatures>>(),
       json.at("spread")});
}

RhythmLikelihood rhythmFrom(const Json& json) {
  return RhythmLikelihood(
      {json.at("mean").get<std::array<double, RhythmLikelihood::kFeatures>>(),
       json.at("whitening").get<std::array<double, RhythmLikelihood::kEntries>>(),
       json.at("heard")});
}

Json jsonOf(const Learned& learned) {
  const EnergyOutlook::Coefficients outlook = learned.outlook.coefficients();
  return {{"reference_impulse", learned.referenceImpulse},
          {"weights", outlook.weights},
          {"spread", outlook.spread},
          {"rest_energy", outlook.restEnergy}};
}

Json jsonOf(const RestitutionOutlook& outlook) {
  return {{"weights", outlook.coefficients().weights}, {"spread", outlook.coefficients().spread}};
}

Json jsonOf(const RhythmLikelihood& rhythm) {
  const RhythmLikelihood::Coefficients all = rhythm.coefficients();
  return {{"mean", all.mean}, {"whitening", all.whitening}, {"heard", all.heard}};
}

void write(const fs::path& file, std::uint64_t key, Json json) {
  json["key"] = key;
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  // A cache that cannot be written is no loss but of time.
  (void)writeFileAtomically(file, json.dump(1) + "\n");
}

/// From the cache, as `take` has it from the file, or else by `make`, and then into the cache.
template <class Take, class Make>
auto learnOnce(const char* what, const Body& body, const SurfaceProperties& surface,
               const fs::path& cache, const Progress& progress, const Take& take, const Make& make)
    -> decltype(make()) {
  const std::uint64_t key = keyOf(body, surface);
  const fs::path file = cache / fmt::format("{}-{:016x}.json", what, key);
  if (!cache.empty()) {
    if (const auto known = read(file, key, take)) return *known;
  }
  progress("learn", 0);
  const auto learned = make();
  if (!cache.empty() && !progress.stopRequested()) write(file, key, jsonOf(learned));
  progress("learn", 1);
  return learned;
}

}  // namespace

Learned learnObject(const Body& body, const SurfaceProperties& surface, const fs::path& cache,
                    const Progress& progress) {
  return learnOnce("object", body, surface, cache, progress, learnedFrom, [&] {
    SurfaceProperties heard = surface;
    if (heard.referenceImpulse <= 0) {
      CalibrationSettings settings;
      settings.simulations = kImpulseDrops;
      heard.referenceImpulse = measureSurface(body, heard, settings).referenceImpulse;
    }
    const BodyModel model(body, heard);
    return Learned{heard.referenceImpulse,
                   EnergyOutlook::learn(body, model, audibleCut(body, heard),
                                        ShootingPlannerSettings().outlookDrops, progress)};
  });
}

RestitutionOutlook learnRestitution(const Body& body, const SurfaceProperties& surface,
                                    const fs::path& cache, const Progress& progress) {
  return learnOnce("restitution", body, surface, cache, progress, restitutionFrom, [&] {
    return RestitutionOutlook::learn(body, surface, audibleCut(body, surface), kRestitutionDrops,
                                     progress);
  });
}

RhythmLikelihood learnRhythm(const Body& body, const SurfaceProperties& surface,
                             const fs::path& cache, const Progress& progress) {
  return learnOnce("rhythm", body, surface, cache, progress, rhythmFrom, [&] {
    return RhythmLikelihood::learn(body, surface, audibleCut(body, surface), kRhythmDrops,
                                   progress);
  });
}

}  // namespace ifa
