// SPDX-License-Identifier: Apache-2.0
// What the floor looks like: a desk, floorboards or a carpet, as a tile that repeats.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "render/optics.h"

namespace ifa::render {

/// Colours of a square tile, with smaller copies for where many of its points share a pixel.
class FloorTexture {
 public:
  /// @param surface  "desk", "wood" or "carpet"; any other surface looks like a desk
  explicit FloorTexture(const std::string& surface);

  /// Mean colour over a pixel's footprint.
  /// @param x, y    m on the floor
  /// @param across  width of the footprint, m
  /// @param along   its vector in the direction in which it is longest, m
  [[nodiscard]] Colour at(float x, float y, float across, const Eigen::Vector2f& along) const;
  [[nodiscard]] const Colour& mean() const { return mean_; }
  /// Width of the lobe in which the floor reflects; 0: it does not.
  [[nodiscard]] float gloss() const { return gloss_; }

 private:
  struct Level {
    int side = 1;
    std::vector<std::array<std::uint8_t, 4>> texels;  ///< square roots of the colours
  };

  void shrink();
  [[nodiscard]] Colour bilinear(const Level& level, float u, float v) const;
  [[nodiscard]] Colour trilinear(float u, float v, float level) const;

  std::vector<Level> levels_;
  Colour mean_;
  float gloss_ = 0;
};

}  // namespace ifa::render
