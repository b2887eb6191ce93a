// SPDX-License-Identifier: Apache-2.0
#include "orient_option.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "pipeline/wishes.h"

namespace ifa {

namespace {

std::optional<Eigen::Vector3d> parseVector(std::string_view text) {
  Eigen::Vector3d vector;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    const auto read = std::from_chars(at, end, vector[axis]);
    if (read.ec != std::errc() || !std::isfinite(vector[axis])) return {};
    at = read.ptr;
    if (axis < 2 && (at == end || *at++ != ',')) return {};
  }
  return at == end ? std::optional(vector) : std::nullopt;
}

std::optional<Eigen::Vector3d> parseWorld(std::string_view text) {
  if (text == "up") return Eigen::Vector3d::UnitZ();
  if (text == "down") return -Eigen::Vector3d::UnitZ();
  return parseVector(text);
}

}  // namespace

Result<OrientationWish> parseOrientation(const std::string& text) {
  const auto wrong = [&](const char* what) {
    return tl::unexpected<Error>({ErrorCode::kUsage, "\"" + text + "\" " + what, "--orient",
                                  "write last:6=up, 3:mouth=down or last:0,0,1=1,0,0"});
  };
  const std::size_t colon = text.find(':'), equals = text.rfind('=');
  if (colon == std::string::npos || equals == std::string::npos || equals < colon) {
    return wrong("is not CONTACT:FACE=DIRECTION");
  }
  OrientationWish wish;
  const auto contact = contactNumber(std::string_view(text).substr(0, colon));
  if (!contact) return wrong("does not begin with a contact's number, from 1, or last");
  wish.contact = *contact;
  const auto world = parseWorld(std::string_view(text).substr(equals + 1));
  if (!world) return wrong("does not end with up, down or three numbers");
  wish.world = *world;
  const std::string face = text.substr(colon + 1, equals - colon - 1);
  if (face.empty()) return wrong("names no face");
  const auto body = parseVector(face);
  if (body) {
    wish.body = *body;
  } else {
    wish.face = face;
  }
  return wish;
}

}  // namespace ifa
