// SPDX-License-Identifier: Apache-2.0
#include "studio/plan_request.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "signature/csv.h"

namespace ifa::studio {
namespace {

using Json = nlohmann::json;

/// Reads fields and keeps the first complaint.
class Fields {
 public:
  Fields(const Json& json, std::string where) : json_(json), where_(std::move(where)) {}

  double number(const char* name, double fallback, double low, double high) {
    const Json* value = find(name);
    if (value == nullptr) return fallback;
    const double number = value->is_number() ? value->get<double>() : NAN;
    if (number >= low && number <= high) return number;
    complain(name, fmt::format("is not a number from {:g} to {:g}", low, high));
    return fallback;
  }
  bool flag(const char* name, bool fallback) {
    const Json* value = find(name);
    if (value == nullptr) return fallback;
    if (value->is_boolean()) return value->get<bool>();
    complain(name, "is neither true nor false");
    return fallback;
  }
  /// One of `choices`, or empty where that may be.
  template <class Choices>
  std::string choice(const char* name, const Choices& choices, bool mayBeEmpty) {
    const Json* value = find(name);
    std::string text = value != nullptr && value->is_string() ? value->get<std::string>() : "";
    if (text.empty() && mayBeEmpty) return text;
    if (choices.find(text) != choices.end()) return text;
    complain(name, "is none that there is");
    return {};
  }
  [[nodiscard]] const Json* find(const char* name) const {
    const auto found = json_.find(name);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }
  void complain(const std::string& name, const std::string& what) {
    if (problem_.empty()) problem_ = where_ + name + " " + what;
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  const Json& json_;
  std::string where_, problem_;
};

Answer<std::vector<Label>> parseMarks(const Json* list) {
  if (list == nullptr || !list->is_array() || list->empty() || list->size() > kMaxMarks) {
    return refuse(422, fmt::format("there are no contacts, or more than {}", kMaxMarks),
                  "mark where the object touches");
  }
  std::vector<Label> marks;
  for (const Json& item : *list) {
    if (!item.is_object()) return refuse(422, "a contact is no object");
    Fields fields(item, fmt::format("contact {}: ", marks.size() + 1));
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
  Fields fields(json, "");
  request.object = fields.choice("object", catalogue, false);
  if (!fields.problem().empty()) return refuse(422, fields.problem(), "choose an object");
  const CatalogueEntry& entry = catalogue.at(request.object);
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
  std::vector<std::string> words = {"sync",
                                    sound.string(),
                                    "--json-progress",
                                    "--labels",
                                    marks.string(),
                                    "--object",
                                    request.object,
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
