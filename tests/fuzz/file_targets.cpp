// SPDX-License-Identifier: Apache-2.0
// Targets: sounds, objects and their meshes, databases, scores, motions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "body/mesh_bytes.h"
#include "body/mesh_import.h"
#include "body/object_file.h"
#include "database/database.h"
#include "database/journal.h"
#include "ensemble/ensemble_file.h"
#include "ensemble/voices.h"
#include "export/motion_json.h"
#include "fuzz/fuzz_targets.h"
#include "fuzz/scratch.h"
#include "sound/onset_detector.h"
#include "sound/sound.h"

namespace ifa::fuzz {

void readAsSound(std::string_view bytes) {
  SoundLimits limits;
  limits.maxBytes = 1 << 24;
  const auto sound = readSound(scratchFile("in", bytes), limits);
  if (!sound) return;
  require(!sound->samples.empty() && sound->rate > 0);
  for (const float sample : sound->samples) require(std::isfinite(sample));
  if (sound->samples.size() < 20000) static_cast<void>(detectContacts(*sound));
}

void readAsScore(std::string_view bytes) {
  const auto score = parseScore(bytes, "score.json");
  if (!score) return;
  std::vector<ScoreNote> notes;
  for (int i = 0; i < 24; ++i) notes.push_back({0.15 * i, 1 + i % 2, 1, 60 + i % 3, 0.5});
  const auto voices = dealVoices(*score, notes, "notes");
  if (!voices) return;
  for (const Voice& voice : *voices) {
    require(voice.part < score->parts.size() && !voice.notes.empty());
    require(signatureOf(voice, true, 0).events.size() == voice.notes.size());
  }
}

void readAsEnsemble(std::string_view bytes) {
  const auto ensemble = parseEnsemble(bytes, "ensemble.json");
  if (!ensemble) return;
  const auto again = parseEnsemble(formatEnsemble(*ensemble), "ensemble.json");
  require(again && again->bodies.size() == ensemble->bodies.size());
  for (std::size_t i = 0; i < again->bodies.size(); ++i) {
    require(again->bodies[i].place.turn == ensemble->bodies[i].place.turn);
    require(again->bodies[i].place.shift == ensemble->bodies[i].place.shift);
  }
}

void readAsMotion(std::string_view bytes) {
  const auto motion = parseMotion(bytes, "motion.json");
  if (!motion) return;
  const auto written = formatMotion(*motion);
  require(written.has_value());
  const auto again = parseMotion(*written, "motion.json");
  require(again && formatMotion(*again).value_or("") == *written);
}

void readAsObject(std::string_view bytes) {
  const auto object = parseObjectFile(bytes, scratch() / "thing.json");
  if (!object) return;
  const auto again = parseObjectFile(objectFileText(*object), scratch() / "thing.json");
  require(again.has_value());
  require(again->name == object->name && again->surfaces.size() == object->surfaces.size());
}

namespace {

/// All that is done with a mesh behind its reader.
void useMesh(Mesh mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const int vertex : triangle) {
      require(vertex >= 0 && static_cast<std::size_t>(vertex) < mesh.vertices.size());
    }
  }
  ObjectDefinition definition;
  definition.mass = 0.01;
  definition.surfaces["desk"] = {};
  const auto body = makeBodyFromMesh(definition, std::move(mesh));
  if (body) require(body->mass > 0 && std::isfinite(body->radius) && !body->hull.empty());
}

/// As it comes from the process that reads meshes: many more shapes a second than through files.
void readAsMeshBytes(std::string_view bytes) {
  const auto mesh = meshFromBytes(bytes);
  if (!mesh) return;
  for (const auto& vertex : mesh->vertices) {
    if (!vertex.allFinite()) return;
  }
  useMesh(weldVertices(*mesh, 1e-6));
}

}  // namespace

void readAsMesh(std::string_view bytes) {
  // The first byte says what the file is called: assimp goes by that.
  constexpr std::array kEndings = {"obj", "stl", "ply", "glb", "gltf", "off", "3mf", "dae"};
  if (bytes.empty()) return;
  const auto kind = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  if (kind >= kEndings.size()) return readAsMeshBytes(bytes);
  auto mesh = importMesh(scratchFile(std::string("mesh.") + kEndings[kind], bytes), 0.01);
  if (mesh) useMesh(std::move(*mesh));
}

void readAsDatabase(std::string_view bytes) {
  std::string text(bytes);
  DatabaseHeader header;
  // Nobody guesses a checksum: the header gets the right one, so that what it says is believed.
  if (text.size() >= sizeof header) {
    std::memcpy(static_cast<void*>(&header), text.data(), sizeof header);
    seal(header);
    std::memcpy(text.data(), &header, sizeof header);
  }
  const auto path = scratchFile("f.ifadb", text);
  if (const auto database = EventDatabase::open(path)) {
    static_cast<void>(database->check());
    for (std::size_t i = 0; i < std::min<std::size_t>(database->events(), 100); ++i) {
      static_cast<void>(database->record(i));
      static_cast<void>(database->nameOf(i));
    }
    for (std::size_t k = 0; k <= std::min<std::size_t>(database->simulations(), 100); ++k) {
      require(database->firstEvent(k) <= database->events());
    }
  }
  test::writeText(journalPath(path), text);
  const auto journal = Journal::resume(path, header);
  if (journal && *journal) {
    require((*journal)->simulations() <= header.simulations);
    if ((*journal)->simulations() == header.simulations) {
      static_cast<void>((*journal)->assemble(scratch() / "whole.ifadb", {}));
    }
  }
}

}  // namespace ifa::fuzz
