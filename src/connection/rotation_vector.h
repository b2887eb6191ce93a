// SPDX-License-Identifier: Apache-2.0
// Logarithm of a rotation, with the same bits everywhere.
#pragma once

#include "base/portable_math.h"
#include "dynamics/lane.h"

namespace ifa {

/// The inverse of turnBy: axis times angle of the shorter way round, rad, at most pi.
/// @param q  unit quaternion, either sign
inline Vec<double> rotationVector(const Quat<double>& q) {
  const double sign = q.w < 0 ? -1 : 1;
  const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  if (sine == 0) return {0, 0, 0};
  const double scale = sign * 2 * portableAngle(sine, sign * q.w) / sine;
  return {q.x * scale, q.y * scale, q.z * scale};
}

}  // namespace ifa
