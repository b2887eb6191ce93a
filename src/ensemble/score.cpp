// SPDX-License-Identifier: Apache-2.0
#include "ensemble/score.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <set>
#include <utility>

#include "base/file.h"
#include "body/field_reader.h"

namespace ifa {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::array<std::array<double, 3>, 6> kPalette = {{{0.08, 0.25, 0.72},
                                                            {0.72, 0.06, 0.07},
                                                            {0.85, 0.55, 0.06},
                                                            {0.08, 0.45, 0.16},
                                                            {0.42, 0.12, 0.5},
                                                            {0.1, 0.48, 0.52}}};

void refuseOthers(const FieldReader& reader, std::initializer_list<const char*> known) {
  for (const auto& item : reader.json().items()) {
    const bool found = std::any_of(known.begin(), known.end(),
                                   [&](const char* name) { return item.key() == name; });
    if (!found) {
      reader.fail(item.key(), "is not known", fmt::format("known are {}", fmt::join(known, ", ")));
    }
  }
}

int wholeNumber(const FieldReader& reader, const char* field, int low, int high, int otherwise) {
  const double value =
      reader.number(field, {static_cast<double>(low), static_cast<double>(high)}, otherwise);
  const int whole = static_cast<int>(value);
  if (whole != value) reader.fail(field, "is not a whole number");
  return whole;
}

bool isPlainName(const std::string& name) {
  return !name.empty() && name.size() <= 40 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](unsigned char letter) {
           return (std::isalnum(letter) != 0 && letter < 128) || letter == '-' || letter == '_' ||
                  letter == '.';
         });
}

void readColour(const FieldReader& reader, ScorePart& part) {
  if (!reader.has("colour")) return;
  const Json& json = reader.json()["colour"];
  std::array<double, 3> colour{};
  const auto good = [](const Json& value) {
    return value.is_number() && value.get<double>() >= 0 && value.get<double>() <= 1;
  };
  if (!json.is_array() || json.size() != 3 || !std::all_of(json.begin(), json.end(), good)) {
    return reader.fail("colour", "must be three numbers from 0 to 1",
                       "red, green, blue: [0.1, 0.3, 0.8]");
  }
  for (std::size_t i = 0; i < 3; ++i) colour[i] = json[i].get<double>();
  part.colour = colour;
}

void readKeys(const FieldReader& reader, ScorePart& part) {
  if (!reader.has("notes")) return;
  const Json& json = reader.json()["notes"];
  const auto good = [](const Json& value) {
    return value.is_number_integer() && value >= 0 && value <= 127;
  };
  if (!json.is_array() || json.empty() || json.size() > 128 ||
      !std::all_of(json.begin(), json.end(), good)) {
    return reader.fail("notes", "must be a list of MIDI notes, 0 to 127", "[36, 38]");
  }
  part.keys = json.get<std::vector<int>>();
}

void readEnding(const FieldReader& reader, ScorePart& part) {
  const std::string ending = reader.text("ending", false);
  if (ending == "bounce") part.rests = false;
  if (!ending.empty() && ending != "bounce" && ending != "rest") {
    reader.fail("ending", "is \"" + ending + "\"", "choose from rest, bounce");
  }
}

ScorePart readPart(const FieldReader& reader) {
  ScorePart part;
  refuseOthers(reader, {"name", "object", "surface", "sound", "colour", "track", "channel", "notes",
                        "bodies", "deal", "restitution", "energy_gain", "ending"});
  part.name = reader.text("name");
  if (!isPlainName(part.name)) {
    reader.fail("name", "must be at most 40 letters, digits, dots, dashes and underscores");
  }
  part.object = reader.text("object");
  part.surface = reader.text("surface", false);
  part.sound = reader.text("sound", false);
  readColour(reader, part);
  part.track = wholeNumber(reader, "track", 1, 65535, 0);
  part.channel = wholeNumber(reader, "channel", 1, 16, 0);
  readKeys(reader, part);
  part.bodies = wholeNumber(reader, "bodies", 1, static_cast<int>(kMostScoreBodies), 1);
  const std::string deal = reader.text("deal", false);
  if (deal == "turns") part.deal = Deal::kTurns;
  if (!deal.empty() && deal != "turns" && deal != "phrases") {
    reader.fail("deal", "is \"" + deal + "\"", "choose from phrases, turns");
  }
  part.restitution = reader.number("restitution", {0, 0.95}, part.restitution);
  part.energyGain = reader.number("energy_gain", {0, 10}, part.energyGain);
  readEnding(reader, part);
  return part;
}

void readParts(const FieldReader& reader, Score& score) {
  const Json& json = reader.json();
  if (!json.contains("parts") || !json["parts"].is_array() || json["parts"].empty() ||
      json["parts"].size() > kMostScoreBodies) {
    return reader.fail("parts", fmt::format("must be a list of 1 to {} parts", kMostScoreBodies));
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < json["parts"].size(); ++i) {
    const std::string place = fmt::format("parts[{}]", i);
    const Json& entry = json["parts"][i];
    if (!entry.is_object()) return reader.fail(place, "is not an object");
    score.parts.push_back(readPart(reader.inside(place, entry)));
    if (!names.insert(score.parts.back().name).second) {
      reader.fail(place + ".name", "is that of another part");
    }
  }
}

}  // namespace

Result<Score> parseScore(std::string_view text, const std::filesystem::path& path) {
  const std::string file = path.string();
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    return badInput("is not a score: not valid JSON", file, "docs/music.md shows one");
  }
  std::optional<Error> error;
  const FieldReader reader(json, file, "", error);
  Score score;
  reader.expectFormat("inverse-foley-score", "this is not a score");
  refuseOthers(reader, {"format", "version", "midi", "seed", "clearance", "parts"});
  score.midi = path.parent_path() / reader.text("midi");
  score.seed = static_cast<std::uint64_t>(wholeNumber(reader, "seed", 0, 1'000'000'000, 1));
  score.clearance = reader.number("clearance", {0, 1}, 0);
  readParts(reader, score);
  if (error) return tl::unexpected(*error);
  return score;
}

Result<Score> readScore(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaxBytes);
  if (!text) return tl::unexpected(text.error());
  return parseScore(*text, path);
}

Score scoreOfNotes(const std::filesystem::path& midi, const std::vector<ScoreNote>& notes,
                   const std::string& object) {
  std::set<std::pair<int, int>> voices;
  for (const ScoreNote& note : notes) voices.insert({note.track, note.channel});
  Score score;
  score.midi = midi;
  for (const auto& [track, channel] : voices) {
    ScorePart part;
    part.name = fmt::format("track-{}-channel-{}", track, channel);
    part.object = object;
    part.track = track;
    part.channel = channel;
    if (voices.size() > 1) part.colour = kPalette[score.parts.size() % kPalette.size()];
    score.parts.push_back(part);
  }
  return score;
}

}  // namespace ifa
