// SPDX-License-Identifier: Apache-2.0
#include "pipeline/evaluation_places.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/file.h"
#include "export/json_node.h"

namespace ifa {
namespace {

constexpr std::size_t kLargestFile = 1 << 20;
constexpr double kFarthest = 1000;  // m

std::vector<Eigen::Vector2d> placesOf(const JsonNode& node) {
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < node.count(); ++i) {
    const JsonNode place = node.item(i);
    if (place.count(2) == 0) return {};
    places.emplace_back(place.item(0).number(-kFarthest, kFarthest),
                        place.item(1).number(-kFarthest, kFarthest));
  }
  if (places.empty()) node.reject("names no place");
  return places;
}

}  // namespace

Result<KnownPlaces> readKnownPlaces(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kLargestFile);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto json = nlohmann::json::parse(*bytes, nullptr, false);
  if (json.is_discarded()) return badInput("is no JSON", path.string());
  std::string problem;
  const JsonNode root(&json, "", &problem);
  KnownPlaces places;
  places.positions = placesOf(root.member("positions"));
  places.labelled = root.has("labelled") ? placesOf(root.member("labelled")) : places.positions;
  if (problem.empty() && places.labelled.size() != places.positions.size()) {
    problem = "'labelled' has not as many places as 'positions'";
  }
  if (!problem.empty()) return badInput(problem, path.string());
  return places;
}

std::vector<PositionWish> wishesFor(const KnownPlaces& places) {
  std::vector<PositionWish> wishes;
  for (const Eigen::Vector2d& place : places.labelled)
    wishes.push_back({static_cast<int>(wishes.size()) + 1, place});
  return wishes;
}

PlaceErrors placeErrors(const KnownPlaces& places, const Motion& motion) {
  PlaceErrors errors;
  Eigen::AlignedBox2d box;
  const std::size_t count = std::min(places.positions.size(), motion.contacts.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double off = (motion.contacts[i].position.head<2>() - places.positions[i]).norm();
    errors.mean += off / static_cast<double>(count);
    errors.largest = std::max(errors.largest, off);
    box.extend(places.positions[i]);
  }
  if (count > 0) errors.longestSide = box.sizes().maxCoeff();
  return errors;
}

}  // namespace ifa
