// SPDX-License-Identifier: Apache-2.0
#include "pipeline/settings_hash.h"

#include <fmt/format.h>

#include "base/hash.h"
#include "base/version.h"

namespace ifa {

namespace {

template <class T>
std::uint64_t bits(T value) {
  return static_cast<std::uint64_t>(value);
}

/// One that is not there differs from any that is.
template <class T>
Hash& addOptional(Hash& hash, const std::optional<T>& value) {
  hash.add(bits(value.has_value()));
  return value ? hash.add(static_cast<double>(*value)) : hash;
}

Hash& add(Hash& hash, const Eigen::Vector3d& vector) {
  return hash.add(vector.x()).add(vector.y()).add(vector.z());
}

void addMarks(Hash& hash, const SynchronizeSettings& settings) {
  hash.add(settings.labels.filename().string());
  hash.add(bits(settings.ignoreCues)).add(bits(settings.midi.track));
  hash.add(bits(settings.midi.channel)).add(bits(settings.midi.durations));
  addOptional(hash, settings.terminal);
}

void addBody(Hash& hash, const SynchronizeSettings& settings) {
  hash.add(settings.objects.string()).add(settings.object).add(settings.surface);
  addOptional(hash, settings.restitution);
  hash.add(settings.restitutionScale).add(bits(settings.fit));
}

void addSearch(Hash& hash, const SynchronizeSettings& settings) {
  hash.add(settings.planner).add(settings.seed).add(bits(settings.takes));
  hash.add(settings.timeLimitSeconds).add(settings.energyGain).add(settings.preRollSeconds);
  const GraphOptions& graph = settings.graph;
  hash.add(graph.database.string()).add(graph.simulations);
  addOptional(hash, graph.cut);
  hash.add(bits(graph.printedVelocity)).add(bits(graph.timeWarp)).add(graph.earlyExit);
  hash.add(bits(graph.processorTime)).add(bits(graph.symmetry));
}

void addWishes(Hash& hash, const SynchronizeSettings& settings) {
  hash.add(bits(settings.orientations.size()));
  for (const OrientationWish& wish : settings.orientations) {
    add(add(hash.add(bits(wish.contact)).add(wish.face), wish.body), wish.world);
  }
  hash.add(bits(settings.positions.size()));
  for (const PositionWish& wish : settings.positions) {
    hash.add(bits(wish.contact)).add(wish.place.x()).add(wish.place.y());
  }
}

void addFilm(Hash& hash, const OutputSettings& output) {
  const FilmOptions& film = output.film;
  hash.add(bits(output.glbSet)).add(bits(film.final)).add(bits(film.width)).add(bits(film.height));
  hash.add(film.framesPerSecond).add(film.shutter).add(film.speed).add(bits(film.mute));
  addOptional(hash, film.camera);
  hash.add(bits(film.overlay)).add(bits(film.sideBySide)).add(film.floor);
}

}  // namespace

std::string hashOf(const SynchronizeSettings& settings, const OutputSettings& output) {
  Hash hash;
  hash.add(programVersion());
  addMarks(hash, settings);
  addBody(hash, settings);
  addSearch(hash, settings);
  addWishes(hash, settings);
  addFilm(hash, output);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace ifa
