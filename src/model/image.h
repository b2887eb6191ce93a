// SPDX-License-Identifier: Apache-2.0
// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
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

/// Copies `picture` into `whole`, its upper left corner at (left, top); it must fit.
inline void paste(const Image& picture, Image& whole, int left, int top) {
  const std::size_t bytes = 3 * static_cast<std::size_t>(picture.width);
  const std::size_t stride = 3 * static_cast<std::size_t>(whole.width);
  std::uint8_t* to = whole.rgb.data() + static_cast<std::size_t>(top) * stride +
                     3 * static_cast<std::size_t>(left);
  for (std::size_t row = 0; row < static_cast<std::size_t>(picture.height); ++row) {
    std::memcpy(to + row * stride, picture.rgb.data() + row * bytes, bytes);
  }
}

}  // namespace ifa
