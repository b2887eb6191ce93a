// SPDX-License-Identifier: Apache-2.0
#include "studio/own_object.h"

#include <fmt/format.h>

#include <set>

#include "studio/json_fields.h"

namespace ifa::studio {

std::optional<std::string> meshKind(const std::string& kind) {
  static const std::set<std::string> kKinds = {"obj", "stl", "ply", "off", "glb"};
  const auto found = kKinds.find(kind);
  return found == kKinds.end() ? std::nullopt : std::optional(*found);
}

Answer<OwnObjectRequest> parseOwnObject(std::string_view text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return refuse(400, "the request is no JSON object");
  static const std::set<std::string> kUnits = {"m", "cm", "mm", "in"};
  JsonFields fields(json, "");
  OwnObjectRequest request;
  request.units = fields.choice("units", kUnits, false);
  request.shell = fields.flag("shell", false);
  request.mass = fields.number("mass", NAN, 1e-6, 1e3);
  request.restitution = fields.number("restitution", 0.5, 0, 0.95);
  request.friction = fields.number("friction", 0.4, 0, 2);
  if (std::isnan(request.mass)) fields.complain("mass", "is missing");
  if (!fields.problem().empty()) return refuse(422, fields.problem());
  return request;
}

std::vector<std::string> objectsArguments(const OwnObjectRequest& request,
                                          const std::filesystem::path& folder) {
  std::vector<std::string> words = {"objects",
                                    (folder / "mesh.obj").string(),
                                    "--json-progress",
                                    "--units",
                                    request.units,
                                    "--mass",
                                    fmt::format("{}", request.mass),
                                    "--restitution",
                                    fmt::format("{}", request.restitution),
                                    "--friction",
                                    fmt::format("{}", request.friction),
                                    "--force",
                                    "-o",
                                    (folder / kOwnObject).string() + ".json"};
  if (request.shell) words.emplace_back("--shell");
  return words;
}

}  // namespace ifa::studio
