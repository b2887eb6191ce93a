// SPDX-License-Identifier: Apache-2.0
#include "pipeline/wishes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/file.h"
#include "signature/text_fields.h"

namespace ifa {

namespace {

constexpr const char* kPlace = "orientation";

Result<Eigen::Vector3d> directionOf(const OrientationWish& wish, const Body& body) {
  if (wish.face.empty()) return wish.body;
  const auto& faces = body.definition.faces;
  const auto found = faces.find(wish.face);
  if (found != faces.end()) return found->second;
  std::string known;
  for (const auto& [name, direction] : faces) known += (known.empty() ? "" : ", ") + name;
  return tl::unexpected<Error>(
      {ErrorCode::kUsage, fmt::format("{} has no face \"{}\"", body.definition.name, wish.face),
       kPlace,
       known.empty() ? "its object file names none: give a direction, as 0,0,1"
                     : "its faces: " + known});
}

tl::unexpected<Error> notThere(int contact, std::size_t contacts, const char* place) {
  return tl::unexpected<Error>(
      {ErrorCode::kUsage, fmt::format("contact {} is not there", contact), place,
       fmt::format("the sound has {} contacts; give 1 to {}", contacts, contacts)});
}

}  // namespace

Result<std::vector<PlannedOrientation>> plannedOrientations(
    const std::vector<OrientationWish>& wishes, const Body& body,
    const ContactSignature& signature) {
  std::vector<PlannedOrientation> planned;
  const std::size_t contacts = signature.events.size();
  for (const OrientationWish& wish : wishes) {
    if (wish.contact < 0 || static_cast<std::size_t>(wish.contact) > contacts) {
      return notThere(wish.contact, contacts, kPlace);
    }
    const auto direction = directionOf(wish, body);
    if (!direction) return tl::unexpected(direction.error());
    const bool finite = direction->allFinite() && wish.world.allFinite();
    if (!finite || direction->norm() < 1e-9 || wish.world.norm() < 1e-9) {
      return tl::unexpected<Error>({ErrorCode::kUsage, "a direction has no length", kPlace,
                                    "give three numbers that are not all zero"});
    }
    const std::size_t target =
        wish.contact == 0 ? contacts - 1 : static_cast<std::size_t>(wish.contact - 1);
    planned.push_back({target, body.bodyFromPrincipal.transpose() * direction->normalized(),
                       wish.world.normalized()});
  }
  return planned;
}

Result<std::vector<PlannedPosition>> plannedPositions(std::vector<PositionWish> wishes,
                                                      const ContactSignature& signature) {
  constexpr const char* kPlaceOfWish = "positions";
  constexpr double kFarthest = 1000;  // m
  const std::size_t contacts = signature.events.size();
  for (PositionWish& wish : wishes) {
    if (wish.contact == 0) wish.contact = static_cast<int>(contacts);
  }
  std::stable_sort(wishes.begin(), wishes.end(), [](const PositionWish& a, const PositionWish& b) {
    return a.contact < b.contact;
  });
  std::vector<PlannedPosition> planned;
  for (const PositionWish& wish : wishes) {
    if (wish.contact < 1 || static_cast<std::size_t>(wish.contact) > contacts) {
      return notThere(wish.contact, contacts, kPlaceOfWish);
    }
    const auto target = static_cast<std::size_t>(wish.contact - 1);
    if (!planned.empty() && planned.back().target == target) {
      return tl::unexpected<Error>({ErrorCode::kUsage,
                                    fmt::format("contact {} has two places", wish.contact),
                                    kPlaceOfWish, "leave one of them out"});
    }
    if (!wish.place.allFinite() || wish.place.norm() > kFarthest) {
      return tl::unexpected<Error>({ErrorCode::kUsage,
                                    fmt::format("contact {} is too far away", wish.contact),
                                    kPlaceOfWish, "give metres"});
    }
    planned.push_back({target, wish.place});
  }
  return planned;
}

std::optional<int> contactNumber(std::string_view text) {
  constexpr double kMostContacts = 1e6;
  if (text == "last") return 0;
  const auto number = numberOf(text);
  if (!number || *number != std::floor(*number) || *number < 1 || *number > kMostContacts) {
    return {};
  }
  return static_cast<int>(*number);
}

namespace {

/// "3<TAB>0.12<TAB>-0.05"
std::optional<PositionWish> parsePosition(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t tab = line.find('\t');
    fields.push_back(trimmed(line.substr(0, tab)));
    if (tab == std::string_view::npos) break;
    line.remove_prefix(tab + 1);
  }
  if (fields.size() != 3) return {};
  const auto contact = contactNumber(fields[0]);
  const auto x = numberOf(fields[1]), y = numberOf(fields[2]);
  if (!contact || !x || !y || !std::isfinite(*x) || !std::isfinite(*y)) return {};
  return PositionWish{*contact, {*x, *y}};
}

}  // namespace

Result<std::vector<PositionWish>> readPositions(const std::filesystem::path& path) {
  const auto bytes = readFile(path, 1 << 20);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto text = checkText(*bytes, path.string());
  if (!text) return tl::unexpected(text.error());
  std::vector<PositionWish> wishes;
  std::string_view rest = *text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = trimmed(takeLine(rest));
    if (line.empty() || line[0] == '#') continue;
    const auto wish = parsePosition(line);
    if (!wish) {
      return badInput("is no place", fmt::format("{}:{}", path.string(), number),
                      "give a contact's number or last, x and y in metres, tabs between");
    }
    wishes.push_back(*wish);
  }
  if (wishes.empty()) return badInput("names no place", path.string(), "one line for each contact");
  return wishes;
}

}  // namespace ifa
