// SPDX-License-Identifier: Apache-2.0
#include "signature/signature_json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/file.h"

namespace ifa {
namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "inverse-foley-signature";
constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr std::size_t kMaxEvents = 10000;
constexpr double kMaxSeconds = 3600;
constexpr double kMaxAmplitude = 1e6;
constexpr double kMaxCost = 1e3;
constexpr double kMinFirstAmplitude = 1e-9;

/// What a number in the file may be.
struct Range {
  double low, high;
};

/// Reads fields and remembers the first complaint, so that the reading code stays a list of fields.
class Fields {
 public:
  explicit Fields(std::string place) : place_(std::move(place)) {}

  /// The number in object[name]; `fallback` where it is missing (NaN: it must not be).
  double number(const Json& object, const std::string& prefix, const char* name, Range range,
                double fallback) {
    const auto found = object.find(name);
    if (found == object.end()) {
      if (std::isnan(fallback)) complain("is missing", prefix + name, "add it");
      return fallback;
    }
    const double value = found->is_number() ? found->get<double>() : NAN;
    if (value >= range.low && value <= range.high) return value;
    complain(fmt::format("must be a number from {:g} to {:g}", range.low, range.high),
             prefix + name, {});
    return fallback;
  }
  void complain(std::string message, const std::string& field, std::string remedy) {
    if (!error_) {
      error_ = badInput(std::move(message), place_ + ": " + field, std::move(remedy)).value();
    }
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  std::string place_;
  std::optional<Error> error_;
};

void readAlternatives(const Json& json, const std::string& prefix, SignatureEvent& event,
                      Fields& fields) {
  const auto found = json.find("alternatives");
  if (found == json.end()) return;
  const std::string field = prefix + "alternatives";
  if (!found->is_array() || found->size() > kMaxAlternatives) {
    return fields.complain(fmt::format("must be a list of at most {}", kMaxAlternatives), field,
                           "{\"time\": s, \"cost\": log units}");
  }
  for (std::size_t i = 0; i < found->size(); ++i) {
    const std::string inner = fmt::format("{}[{}].", field, i);
    if (!(*found)[i].is_object()) return fields.complain("is not an object", inner, {});
    event.alternatives.push_back({fields.number((*found)[i], inner, "time", {0, kMaxSeconds}, NAN),
                                  fields.number((*found)[i], inner, "cost", {0, kMaxCost}, NAN)});
  }
}

SignatureEvent readEvent(const Json& json, const std::string& prefix, Fields& fields) {
  SignatureEvent event;
  event.time = fields.number(json, prefix, "time", {0, kMaxSeconds}, NAN);
  event.duration = fields.number(json, prefix, "duration", {0, kMaxSeconds}, 0);
  event.amplitude = fields.number(json, prefix, "amplitude", {0, kMaxAmplitude}, 1);
  event.centroid = fields.number(json, prefix, "centroid", {0, kMaxSeconds}, 0);
  event.weight = fields.number(json, prefix, "weight", {0, 1}, 1);
  readAlternatives(json, prefix, event, fields);
  if (event.centroid > event.duration + 1e-9) {
    fields.complain("lies after the event's end", prefix + "centroid",
                    "count it from the event's start, in seconds");
  }
  return event;
}

void checkOrder(const std::vector<SignatureEvent>& events, Fields& fields) {
  for (std::size_t i = 1; i < events.size(); ++i) {
    const std::string field = fmt::format("events[{}].time", i);
    const SignatureEvent& before = events[i - 1];
    if (events[i].time <= before.time) {
      fields.complain("is not after the event before it", field, "sort the events by time");
    } else if (events[i].time < before.time + before.duration - 1e-9) {
      fields.complain("lies inside the event before it", field, "shorten that one's duration");
    }
  }
}

void checkAlternatives(const std::vector<SignatureEvent>& events, Fields& fields) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::string field = fmt::format("events[{}].alternatives", i);
    if (i == 0 && !events[i].alternatives.empty()) {
      fields.complain("belong to the first event", field, "all times count from it; move it");
    }
    for (const AlternativeStart& other : events[i].alternatives) {
      const bool last = i + 1 == events.size();
      if (i > 0 && other.time > events[i - 1].time && (last || other.time < events[i + 1].time)) {
        continue;
      }
      fields.complain("lie outside the events before and after", field, {});
    }
  }
}

void readEvents(const Json& json, ContactSignature& signature, Fields& fields) {
  const auto events = json.find("events");
  if (events == json.end() || !events->is_array() || events->empty()) {
    return fields.complain("holds no events", "events", "give at least one");
  }
  if (events->size() > kMaxEvents) {
    return fields.complain(fmt::format("holds more than {} events", kMaxEvents), "events", {});
  }
  for (std::size_t i = 0; i < events->size(); ++i) {
    const std::string prefix = fmt::format("events[{}].", i);
    if (!(*events)[i].is_object()) return fields.complain("is not an object", prefix, {});
    signature.events.push_back(readEvent((*events)[i], prefix, fields));
  }
  checkOrder(signature.events, fields);
  checkAlternatives(signature.events, fields);
}

/// First event at 0 with amplitude 1.
void normalise(ContactSignature& signature, Fields& fields) {
  const SignatureEvent first = signature.events.front();
  if (first.amplitude < kMinFirstAmplitude) {
    return fields.complain("is too near 0: all others are relative to it", "events[0].amplitude",
                           {});
  }
  signature.firstContact += first.time;
  for (SignatureEvent& event : signature.events) {
    event.time -= first.time;
    event.amplitude /= first.amplitude;
    for (AlternativeStart& other : event.alternatives) other.time -= first.time;
  }
}

void readHead(const Json& json, ContactSignature& signature, Fields& fields) {
  if (json.value("format", Json()) != kFormat) {
    return fields.complain(fmt::format("is not \"{}\"", kFormat), "format",
                           "is this a signature file?");
  }
  if (json.value("version", Json()) != 1) {
    return fields.complain("is not 1, the only one known", "version", "use a newer program");
  }
  const auto terminal = json.value("terminal", Json(true));
  if (!terminal.is_boolean()) return fields.complain("must be true or false", "terminal", {});
  signature.terminal = terminal.get<bool>();
  signature.firstContact = fields.number(json, "", "first_contact", {0, kMaxSeconds}, 0);
}

}  // namespace

Result<ContactSignature> parseSignature(std::string_view json, const std::string& place) {
  const Json parsed = Json::parse(json, nullptr, false);
  if (parsed.is_discarded() || !parsed.is_object()) {
    return badInput("is not a JSON object", place, "see docs/file-formats.md");
  }
  Fields fields(place);
  ContactSignature signature;
  readHead(parsed, signature, fields);
  if (!fields.error()) readEvents(parsed, signature, fields);
  if (!fields.error()) normalise(signature, fields);
  if (fields.error()) return tl::unexpected<Error>(*fields.error());
  return signature;
}

Result<ContactSignature> readSignature(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaxBytes);
  if (!text) return tl::unexpected<Error>(text.error());
  return parseSignature(*text, path.string());
}

std::string formatSignature(const ContactSignature& signature) {
  nlohmann::ordered_json json{{"format", kFormat}, {"version", 1}};
  auto& events = json["events"] = nlohmann::ordered_json::array();
  for (const SignatureEvent& event : signature.events) {
    events.push_back({{"time", event.time},
                      {"duration", event.duration},
                      {"amplitude", event.amplitude},
                      {"centroid", event.centroid},
                      {"weight", event.weight}});
    for (const AlternativeStart& other : event.alternatives) {
      events.back()["alternatives"].push_back({{"time", other.time}, {"cost", other.cost}});
    }
  }
  json["terminal"] = signature.terminal;
  json["first_contact"] = signature.firstContact;
  return json.dump(1) + "\n";
}

Result<void> writeSignature(const std::filesystem::path& path, const ContactSignature& signature) {
  return writeFileAtomically(path, formatSignature(signature));
}

}  // namespace ifa
