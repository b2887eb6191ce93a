// SPDX-License-Identifier: Apache-2.0
#include "studio/plan_request.h"

#include <fmt/format.h>

#include <cmath>

#include "signature/csv.h"
#include "studio/json_fields.h"

namespace ifa::studio {
namespace {

using Json = nlohmann::json;

Answer<std::vector<Label>> parseMarks(const Json* list) {
  if (list == nullptr || !list->is_array() || list->empty() || list->size() > kMaxMarks) {
    return refuse(422, fmt::format("there are no contacts, or more than {}", kMaxMarks),
                  "mark where the object touches");
  }
  std::vector<Label> marks;
  for (const Json& item : *list) {
    if (!item.is_object()) return refuse(422, "a contact is no object");
    JsonFields fields(item, fmt::format("contact {}: ", marks.size() + 1));
    Label mark;
    mark.start = fields.number("start", NAN, 0, 3600);
    mark.end = fields.number("end", mark.start, 0, 3600);
    mark.weight = fields.number("weight", 1, 0.01, 1);
    if (std::isnan(mark.start)) fields.complain("start", "is missing");
    if (mark.end < mark.start) fields.complain("end", "is before its start");
    if (!marks.empty() && mark.start <= marks.back().end) {
      fields.complain("start", "is not after the contact before it");
    }
    if (!fields.problem().empty()) return refuse(422, fields.problem());
    mark.text = fmt::format("c{}", marks.size() + 1);
    marks.push_back(std::move(mark));
  }
  return marks;
}

using Landing = std::optional<std::array<double, 2>>;

Answer<Landing> parseLanding(const Json* landing, std::size_t contacts) {
  if (landing == nullptr) return Landing();
  if (!landing->is_object()) return refuse(422, "landing is no place");
  if (contacts < 2) return refuse(422, "landing needs a contact before it");
  JsonFields fields(*landing, "landing: ");
  const std::array<double, 2> place = {fields.number("x", NAN, -kMaxLanding, kMaxLanding),
                                       fields.number("y", NAN, -kMaxLanding, kMaxLanding)};
  if (!fields.problem().empty()) return refuse(422, fields.problem());
  if (std::isnan(place[0]) || std::isnan(place[1])) return refuse(422, "landing needs x and y");
  return place;
}

}  // namespace

Answer<PlanRequest> parsePlanRequest(std::string_view text,
                                     const std::map<std::string, CatalogueEntry>& catalogue) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return refuse(400, "the request is no JSON object");
  auto marks = parseMarks(json.contains("marks") ? &json["marks"] : nullptr);
  if (!marks) return tl::unexpected(marks.error());
  PlanRequest request;
  request.marks = std::move(*marks);
  JsonFields fields(json, "");
  request.object = fields.choice("object", catalogue, false);
  if (!fields.problem().empty()) return refuse(422, fields.problem(), "choose an object");
  const CatalogueEntry& entry = catalogue.at(request.object);
  request.objectFile = entry.file;
  request.surface = fields.choice("surface", entry.surfaces, true);
  request.face = fields.choice("face", entry.faces, true);
  request.terminal = fields.flag("terminal", request.terminal);
  request.fit = fields.flag("fit", request.fit);
  request.takes = static_cast<int>(fields.number("takes", request.takes, 1, kMaxTakes));
  request.seed = static_cast<std::int64_t>(fields.number("seed", 1, 0, 9007199254740992.0));
  request.timeLimit = fields.number("timeLimit", request.timeLimit, 1, 60);
  if (!fields.problem().empty()) return refuse(422, fields.problem());
  const auto landing = parseLanding(fields.find("landing"), request.marks.size());
  if (!landing) return tl::unexpected(landing.error());
  request.landing = *landing;
  request.marks.back().text = request.terminal ? "terminal" : "non-terminal";
  return request;
}

std::string marksTable(const PlanRequest& request) { return formatCsv(request.marks); }

std::string placesTable(const PlanRequest& request) {
  if (!request.landing) return {};
  const auto& [x, y] = *request.landing;
  return fmt::format("1\t0\t0\nlast\t{}\t{}\n", x, y);
}

std::vector<std::string> syncArguments(const PlanRequest& request, const PlanFiles& files,
                                       const std::filesystem::path& output) {
  std::vector<std::string> words = {
      "sync",
      files.sound.string(),
      "--json-progress",
      "--labels",
      files.marks.string(),
      "--object",
      request.objectFile.empty() ? request.object : request.objectFile.string(),
      "--takes",
      std::to_string(request.takes),
      "--seed",
      std::to_string(request.seed),
      "--time-limit",
      fmt::format("{}", request.timeLimit),
      "--formats",
      "json,glb,usda,csv",
      "-o",
      output.string()};
  const auto add = [&words](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  if (!request.surface.empty()) add("--surface", request.surface);
  if (!request.face.empty()) add("--orient", "last:" + request.face + "=up");
  if (request.landing) add("--positions", files.places.string());
  if (request.fit) words.emplace_back("--fit");
  return words;
}

}  // namespace ifa::studio
