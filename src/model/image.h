// SPDX-License-Identifier: Apache-2.0
// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ifa {

/// Rows from the top, three bytes a pixel (red, green, blue; sRGB), no padding.
struct Image {
  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 3) {}

  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace ifa
