// SPDX-License-Identifier: Apache-2.0
#include "render/tone.h"

namespace ifa::render {

ScreenCurve::ScreenCurve() {
  for (std::size_t i = 0; i < kSize; ++i) {
    const float root = static_cast<float>(i) / (kSize - 1), x = root * root;
    const float screen = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    table_[i] = static_cast<std::uint8_t>(std::lround(255 * screen));
  }
}

}  // namespace ifa::render
