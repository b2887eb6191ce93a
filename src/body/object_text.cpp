// SPDX-License-Identifier: Apache-2.0
// Object files: definition to text, laid out so that a person can read it and a diff stays small.
#include <cmath>
#include <nlohmann/json.hpp>

#include "body/object_file.h"

namespace ifa {

using Json = nlohmann::ordered_json;

namespace {

// 30 and not 30.0, as people write it.
std::string numberText(double value) {
  const bool whole = std::abs(value) < 1e15 && value == std::trunc(value);
  return whole ? std::to_string(static_cast<long long>(value)) : Json(value).dump();
}

/// One line: {"a": 1, "b": [0, 0, 1]}.
std::string oneLine(const Json& json) {
  if (json.is_number_float()) return numberText(json.get<double>());
  if (!json.is_structured()) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  std::string text;
  for (auto item = json.begin(); item != json.end(); ++item) {
    if (!text.empty()) text += ", ";
    if (json.is_object()) text += Json(item.key()).dump() + ": ";
    text += oneLine(*item);
  }
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

/// One entry a line.
std::string oneEntryPerLine(const Json& object, const std::string& indent) {
  std::string text;
  for (auto item = object.begin(); item != object.end(); ++item) {
    const bool nested = item->is_object() && (item.key() == "surfaces" || item.key() == "faces");
    text += (text.empty() ? "" : ",\n") + indent + Json(item.key()).dump() + ": " +
            (nested ? oneEntryPerLine(*item, indent + "  ") : oneLine(*item));
  }
  return "{\n" + text + "}";
}

Json surfaceJson(const SurfaceProperties& surface) {
  Json json = {{"restitution", surface.restitution},
               {"friction", surface.friction},
               {"rolling_friction", surface.rollingFriction},
               {"spinning_friction", surface.spinningFriction}};
  if (surface.referenceImpulse > 0) json["reference_impulse"] = surface.referenceImpulse;
  return json;
}

void putMass(Json& json, BodyKind kind, double mass, double density) {
  json["kind"] = kind == BodyKind::kShell ? "shell" : "solid";
  if (mass > 0) {
    json["mass"] = mass;
  } else {
    json["density"] = density;
  }
}

void putShape(Json& json, const ObjectDefinition& definition) {
  json["mesh"] = definition.meshFile;
  if (!definition.hullFile.empty()) json["hull"] = definition.hullFile;
  json["units"] = definition.units;
  if (definition.parts.empty()) {
    return putMass(json, definition.kind, definition.mass, definition.density);
  }
  json["parts"] = Json::array();
  for (const ObjectPart& part : definition.parts) {
    Json entry = {{"mesh", part.meshFile}};
    putMass(entry, part.kind, part.mass, part.density);
    json["parts"].push_back(entry);
  }
}

}  // namespace

std::string objectFileText(const ObjectDefinition& definition) {
  Json json = {{"format", "inverse-foley-object"}, {"version", 1}, {"name", definition.name}};
  if (!definition.title.empty()) json["title"] = definition.title;
  putShape(json, definition);
  if (!definition.material.empty()) json["material"] = definition.material;
  for (const auto& [name, surface] : definition.surfaces) {
    json["surfaces"][name] = surfaceJson(surface);
  }
  json["default_surface"] = definition.defaultSurface;
  const SamplingSettings& sampling = definition.sampling;
  json["sampling"] = {
      {"cone_degrees", sampling.coneDegrees}, {"speed", sampling.speed}, {"spin", sampling.spin}};
  json["merge_gap"] = definition.mergeGap;
  for (const auto& [name, face] : definition.faces) {
    // Nine digits: the reader makes it a unit vector again.
    const Eigen::Vector3d rounded = (face * 1e9).array().round() / 1e9;
    json["faces"][name] = {rounded.x(), rounded.y(), rounded.z()};
  }
  if (!definition.notes.empty()) json["notes"] = definition.notes;
  return oneEntryPerLine(json, "  ") + "\n";
}

}  // namespace ifa
