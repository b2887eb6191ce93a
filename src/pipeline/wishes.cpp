// SPDX-License-Identifier: Apache-2.0
#include "pipeline/wishes.h"

#include <fmt/format.h>

#include <string>

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

}  // namespace

Result<std::vector<PlannedOrientation>> plannedOrientations(
    const std::vector<OrientationWish>& wishes, const Body& body,
    const ContactSignature& signature) {
  std::vector<PlannedOrientation> planned;
  const std::size_t contacts = signature.events.size();
  for (const OrientationWish& wish : wishes) {
    if (wish.contact < 0 || static_cast<std::size_t>(wish.contact) > contacts) {
      return tl::unexpected<Error>(
          {ErrorCode::kUsage, fmt::format("contact {} is not there", wish.contact), kPlace,
           fmt::format("the sound has {} contacts; give 1 to {}, or last", contacts, contacts)});
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

}  // namespace ifa
