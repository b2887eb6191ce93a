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
  request.takes = static_cast<int>(fields.number("takes", request.takes, 1, 6));
  request.seed = static_cast<std::int64_t>(fields.number("seed", 1, 0, 9007199254740992.0));
  request.timeLimit = fields.number("timeLimit", request.timeLimit, 1, 60);
  if (!fields.problem().empty()) return refuse(422, fields.problem());
  request.marks.back().text = request.terminal ? "terminal" : "non-terminal";
  return request;
}

std::string marksTable(const PlanRequest& request) { return formatCsv(request.marks); }

std::vector<std::string> syncArguments(const PlanRequest& request,
                                       const std::filesystem::path& sound,
                                       const std::filesystem::path& marks,
                                       const std::filesystem::path& output) {
  std::vector<std::string> words = {
      "sync",
      sound.string(),
      "--json-progress",
      "--labels",
      marks.string(),
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
  if (request.fit) words.emplace_back("--fit");
  return words;
}

}  // namespace ifa::studio
