// SPDX-License-Identifier: Apache-2.0
// Looking at pictures in numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "model/image.h"

namespace ifa::test {

/// Red, green and blue of a pixel, 0 to 255.
inline std::array<int, 3> pixelAt(const Image& image, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

/// Sum of a pixel's three values.
inline int brightness(const Image& image, int x, int y) {
  const auto p = pixelAt(image, x, y);
  return p[0] + p[1] + p[2];
}

inline double meanBrightness(const Image& image, int left, int top, int right, int bottom) {
  double sum = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) sum += brightness(image, x, y);
  }
  return sum / ((right - left) * (bottom - top));
}

/// Pixels of two pictures of one size that differ by more than `level` in a colour.
inline int differences(const Image& a, const Image& b, int level = 0) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    bool differs = false;
    for (std::size_t k = i; k < i + 3; ++k)
      differs = differs || std::abs(a.rgb[k] - b.rgb[k]) > level;
    count += differs ? 1 : 0;
  }
  return count;
}

/// Peak signal to noise ratio, dB.
inline double psnr(const Image& a, const Image& b) {
  double squares = 1e-9;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const double d = a.rgb[i] - b.rgb[i];
    squares += d * d;
  }
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.rgb.size()) / squares);
}

}  // namespace ifa::test
