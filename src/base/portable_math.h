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

/// Angle of the point (x, y) with x, y >= 0, not both 0, from the x axis: 0 to pi / 2 rad, good to
/// a few units in the last place. The angle is halved twice, then a series.
inline double portableAngle(double y, double x) {
  const bool steep = y > x;
  const double t = steep ? x / y : y / x;
  const double half = t / (1 + std::sqrt(1 + t * t));
  const double quarter = half / (1 + std::sqrt(1 + half * half));  // at most tan(pi / 16)
  const double q2 = quarter * quarter;
  double sum = 0;
  for (int k = 23; k >= 1; k -= 2) sum = 1.0 / k - sum * q2;
  const double angle = 4 * quarter * sum;
  return steep ? 1.5707963267948966 - angle : angle;
}

}  // namespace ifa
