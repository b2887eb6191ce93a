// SPDX-License-Identifier: Apache-2.0
#include "ensemble/ensemble_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "body/field_reader.h"
#include "ensemble/score.h"

namespace ifa {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr const char* kFormat = "inverse-foley-ensemble";

bool staysInside(const std::string& text) {
  const fs::path path(text);
  return path.is_relative() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& name) { return name == ".."; });
}

EnsembleBody readBody(const FieldReader& reader) {
  EnsembleBody body;
  body.name = reader.text("name");
  body.part = reader.text("part", false);
  body.motion = reader.text("motion", true, 1000);
  if (!staysInside(body.motion)) reader.fail("motion", "leads out of the folder");
  body.place.turn = reader.number("turn", {-100, 100});
  body.place.shift = {reader.number("x", {-1e4, 1e4}), reader.number("y", {-1e4, 1e4})};
  return body;
}

}  // namespace

std::string formatEnsemble(const Ensemble& ensemble) {
  using Json = nlohmann::ordered_json;
  const auto text = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::string bodies;
  for (const EnsembleBody& body : ensemble.bodies) {
    const Json json = {{"name", body.name},         {"part", body.part},
                       {"motion", body.motion},     {"turn", body.place.turn},
                       {"x", body.place.shift.x()}, {"y", body.place.shift.y()}};
    bodies += (bodies.empty() ? "" : ",\n") + ("  " + text(json));
  }
  return fmt::format(
      "{{\"format\": \"{}\", \"version\": 1,\n \"program\": {}, \"seed\": {}, \"sound\": {}, "
      "\"clearance\": {},\n \"bodies\": [\n{}]}}\n",
      kFormat, text(ensemble.program), ensemble.seed, text(ensemble.sound),
      text(ensemble.clearance), bodies);
}

Result<Ensemble> parseEnsemble(std::string_view json, const std::string& place) {
  const auto parsed = nlohmann::json::parse(json.begin(), json.end(), nullptr, false);
  if (parsed.is_discarded() || !parsed.is_object()) return badInput("is not valid JSON", place);
  std::optional<Error> error;
  const FieldReader reader(parsed, place, "", error);
  Ensemble ensemble;
  reader.expectFormat(kFormat, "this is not an ensemble");
  ensemble.program = reader.text("program", false);
  ensemble.sound = reader.text("sound", false);
  if (!staysInside(ensemble.sound)) reader.fail("sound", "leads out of the folder");
  ensemble.seed = static_cast<std::uint64_t>(reader.number("seed", {0, 1e15}, 0));
  ensemble.clearance = reader.number("clearance", {0, 1}, 0);
  const auto bodies = parsed.find("bodies");
  if (bodies == parsed.end() || !bodies->is_array() || bodies->empty() ||
      bodies->size() > kMostScoreBodies) {
    reader.fail("bodies", fmt::format("must be a list of 1 to {} bodies", kMostScoreBodies));
  }
  if (error) return tl::unexpected(*error);
  for (std::size_t i = 0; i < bodies->size(); ++i) {
    const std::string name = fmt::format("bodies[{}]", i);
    if (!(*bodies)[i].is_object()) return badInput("is not an object", place + ": " + name);
    ensemble.bodies.push_back(readBody(reader.inside(name, (*bodies)[i])));
  }
  if (error) return tl::unexpected(*error);
  return ensemble;
}

Result<Ensemble> readEnsemble(const fs::path& path) {
  const auto text = readFile(path, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  return parseEnsemble(*text, path.string());
}

}  // namespace ifa
