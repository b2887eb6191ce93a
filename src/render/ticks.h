// SPDX-License-Identifier: Apache-2.0
// Round numbers for the axes of pictures.
#pragma once

#include <cmath>

namespace ifa {

/// Distance of ticks: 1, 2 or 5 times a power of ten, near `span / count` and not under it.
/// @param span, count  positive
[[nodiscard]] inline double tickStep(double span, double count) {
  const double rough = span / count;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  return power * (rough / power <= 1 ? 1 : rough / power <= 2 ? 2 : rough / power <= 5 ? 5 : 10);
}

}  // namespace ifa
