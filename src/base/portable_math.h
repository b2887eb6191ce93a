// SPDX-License-Identifier: Apache-2.0
// Functions whose bits must be the same on every processor; the C library's are not
// (docs/determinism.md).
#pragma once

#include <cmath>

namespace ifa {

/// Natural logarithm of x > 0, good to a few units in the last place: the exponent apart, then
/// log m = 2 artanh((m - 1) / (m + 1)) as a series.
inline double portableLog(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // exact
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1), s2 = s * s;
  double sum = 0;
  for (int k = 23; k >= 1; k -= 2) sum = sum * s2 + 1.0 / k;
  return 2 * s * sum + exponent * 0.69314718055994531;
}

}  // namespace ifa
