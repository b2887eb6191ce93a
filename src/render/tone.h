// SPDX-License-Identifier: Apache-2.0
// From light to the numbers of a screen.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "render/optics.h"

namespace ifa::render {

/// Bends what is brighter than half of white towards white, which it never passes: highlights keep
/// their shape, and nothing is clipped.
inline Colour toned(const Colour& radiance) {
  constexpr float kKnee = 0.5f;
  const auto bend = [](float x) {
    return x <= kKnee ? std::max(x, 0.0f) : 1 - (1 - kKnee) * std::exp((kKnee - x) / (1 - kKnee));
  };
  return {bend(radiance.x()), bend(radiance.y()), bend(radiance.z())};
}

/// sRGB's curve from a table: exact to a quarter of a level.
class ScreenCurve {
 public:
  ScreenCurve();
  /// @param value  0 to 1; what is no number is black
  [[nodiscard]] std::uint8_t operator()(float value) const {
    const float root = std::sqrt(std::min(std::max(0.0f, value), 1.0f));
    constexpr float kHalf = 0.5f;
    return table_[static_cast<std::size_t>(root * (kSize - 1) + kHalf)];
  }

 private:
  static constexpr std::size_t kSize = 4096;
  std::array<std::uint8_t, kSize> table_{};
};

}  // namespace ifa::render
