// SPDX-License-Identifier: Apache-2.0
// Object files: text to definition, every field checked.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/file.h"
#include "body/field_reader.h"
#include "body/object_file.h"

namespace ifa {

using Json = nlohmann::json;

namespace {

constexpr std::size_t kMaxObjectBytes = 1 << 20;
constexpr std::size_t kMaxEntries = 64;  ///< surfaces, faces or parts of one object
constexpr std::size_t kMaxName = 64;

constexpr NumberRange kMass{1e-6, 1e3}, kDensity{1e-3, 3e4}, kRestitution{0, 0.95}, kFriction{0, 2},
    kRollingFriction{0, 0.1}, kReferenceImpulse{0, 1e3}, kCone{0, 90}, kSpeed{0, 100},
    kSpin{0, 1e3}, kMergeGap{0, 1};

bool isPlainName(const std::string& name) {
  return !name.empty() && name.size() <= kMaxName && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                  c == '_' || c == '-' || c == '.';
         });
}

BodyKind readKind(const FieldReader& reader) {
  const std::string kind = reader.text("kind");
  if (kind != "solid" && kind != "shell") reader.fail("kind", "must be \"solid\" or \"shell\"");
  return kind == "shell" ? BodyKind::kShell : BodyKind::kSolid;
}

// Either of the two, never both: they would contradict each other.
void readMassOrDensity(const FieldReader& reader, double& mass, double& density) {
  if (reader.has("mass") && reader.has("density")) {
    reader.fail("density", "stands beside a mass", "state one of the two");
  } else if (reader.has("density")) {
    density = reader.number("density", kDensity);
  } else {
    mass = reader.number("mass", kMass);
  }
}

SurfaceProperties readSurface(const FieldReader& reader) {
  SurfaceProperties surface;
  surface.restitution = reader.number("restitution", kRestitution);
  surface.friction = reader.number("friction", kFriction);
  surface.rollingFriction = reader.number("rolling_friction", kRollingFriction, 0);
  surface.spinningFriction = reader.number("spinning_friction", kRollingFriction, 0);
  surface.referenceImpulse = reader.number("reference_impulse", kReferenceImpulse, 0);
  return surface;
}

void readSurfaces(const FieldReader& reader, ObjectDefinition& definition) {
  if (!reader.has("surfaces")) return reader.fail("surfaces", "is missing");
  const FieldReader surfaces = reader.inside("surfaces");
  if (surfaces.json().empty()) return reader.fail("surfaces", "names no surface");
  if (surfaces.json().size() > kMaxEntries) return reader.fail("surfaces", "has too many entries");
  for (const auto& item : surfaces.json().items()) {
    if (!isPlainName(item.key())) surfaces.fail(item.key(), "is not a plain name");
    definition.surfaces[item.key()] = readSurface(surfaces.inside(item.key(), item.value()));
  }
  definition.defaultSurface = reader.text("default_surface");
  if (!definition.surfaces.contains(definition.defaultSurface)) {
    reader.fail("default_surface",
                "\"" + definition.defaultSurface + "\" is not among the surfaces");
  }
}

void readFaces(const FieldReader& reader, ObjectDefinition& definition) {
  if (!reader.has("faces")) return;
  const FieldReader faces = reader.inside("faces");
  if (faces.json().size() > kMaxEntries) return reader.fail("faces", "has too many entries");
  for (const auto& item : faces.json().items()) {
    const Json& value = item.value();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    const bool three = value.is_array() && value.size() == 3;
    for (std::size_t i = 0; three && i < 3; ++i) {
      if (value[i].is_number()) direction[static_cast<Eigen::Index>(i)] = value[i].get<double>();
    }
    const double length = direction.norm();
    if (!three || !std::isfinite(length) || std::abs(length - 1) > 1e-3) {
      faces.fail(item.key(), "must be three numbers, a vector of length 1");
    } else {
      definition.faces[item.key()] = direction / length;
    }
  }
}

void readSampling(const FieldReader& reader, ObjectDefinition& definition) {
  definition.mergeGap = reader.number("merge_gap", kMergeGap, definition.mergeGap);
  if (!reader.has("sampling")) return;
  const FieldReader sampling = reader.inside("sampling");
  SamplingSettings& s = definition.sampling;
  s.coneDegrees = sampling.number("cone_degrees", kCone, s.coneDegrees);
  s.speed = sampling.interval("speed", kSpeed, s.speed);
  s.spin = sampling.interval("spin", kSpin, s.spin);
}

std::string besideFile(const std::filesystem::path& file, const std::string& name) {
  return name.empty() ? name : (file.parent_path() / name).lexically_normal().string();
}

void readParts(const FieldReader& reader, ObjectDefinition& definition) {
  const Json& list = reader.json()["parts"];
  if (!list.is_array() || list.empty() || list.size() > kMaxEntries) {
    return reader.fail("parts", "must be a list of 1 to 64 parts");
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const FieldReader inside = reader.inside(fmt::format("parts[{}]", i), list[i]);
    ObjectPart part;
    part.meshFile = inside.text("mesh");
    part.meshPath = besideFile(definition.path, part.meshFile);
    part.kind = readKind(inside);
    readMassOrDensity(inside, part.mass, part.density);
    definition.parts.push_back(std::move(part));
  }
}

void readShape(const FieldReader& reader, ObjectDefinition& definition) {
  definition.meshFile = reader.text("mesh");
  definition.meshPath = besideFile(definition.path, definition.meshFile);
  definition.hullFile = reader.text("hull", false);
  definition.hullPath = besideFile(definition.path, definition.hullFile);
  definition.units = reader.text("units");
  if (metresPerUnit(definition.units) == 0) {
    reader.fail("units", "\"" + definition.units + "\" is not m, cm, mm or in");
  }
  if (!reader.has("parts")) {
    definition.kind = readKind(reader);
    return readMassOrDensity(reader, definition.mass, definition.density);
  }
  for (const char* other : {"mass", "density"}) {
    if (reader.has(other)) reader.fail(other, "stands beside parts", "give each part its own");
  }
  readParts(reader, definition);
}

void readHeading(const FieldReader& reader, ObjectDefinition& definition) {
  reader.expectFormat("inverse-foley-object", "this is not an object file");
  definition.name = reader.text("name");
  if (!isPlainName(definition.name)) {
    reader.fail("name", "must be at most 64 letters, digits, dots, dashes and underscores");
  }
  definition.title = reader.text("title", false);
  definition.material = reader.text("material", false);
  definition.notes = reader.text("notes", false, 10'000);
}

}  // namespace

double metresPerUnit(std::string_view units) {
  if (units == "m") return 1;
  if (units == "cm") return 0.01;
  if (units == "mm") return 0.001;
  return units == "in" ? 0.0254 : 0;
}

Result<ObjectDefinition> parseObjectFile(std::string_view text, const std::filesystem::path& path) {
  const std::string file = path.string();
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    return badInput(
        "is not an object file: not valid JSON", file,
        "make one from a mesh with: ifa objects MESH --units mm --density D -o NAME.json");
  }
  std::optional<Error> error;
  const FieldReader reader(json, file, "", error);
  ObjectDefinition definition;
  definition.path = file;
  readHeading(reader, definition);
  readShape(reader, definition);
  readSurfaces(reader, definition);
  readSampling(reader, definition);
  readFaces(reader, definition);
  if (error) return tl::unexpected(*error);
  return definition;
}

Result<ObjectDefinition> readObjectFile(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaxObjectBytes);
  if (!text) return tl::unexpected(text.error());
  return parseObjectFile(*text, path);
}

}  // namespace ifa
