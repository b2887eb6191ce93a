// SPDX-License-Identifier: Apache-2.0
// Directions, colours, rays, and the small pieces of reflection that light and bodies share.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ifa::render {

using Vector = Eigen::Vector3f;  ///< m, or a unit direction; world frame unless said
using Colour = Eigen::Array3f;   ///< linear red, green, blue

inline constexpr float kPi = 3.14159265f;

struct Ray {
  Vector origin, direction;  ///< direction is a unit vector
};

/// Two directions that make a right-handed frame with a unit vector (Duff et al., JCGT 2017).
struct Frame {
  explicit Frame(const Vector& n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z());
    const float a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
    tangent = {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
    bitangent = {b, sign + n.y() * n.y() * a, -n.y()};
  }
  [[nodiscard]] Vector toWorld(float x, float y, float z) const {
    return x * tangent + y * bitangent + z * normal;
  }
  Vector tangent, bitangent, normal;
};

/// Direction about the frame's normal with density cosine / pi, for an even point of the unit disc.
inline Vector cosineDirection(const Frame& frame, float x, float y) {
  return frame.toWorld(x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y)));
}

inline Vector reflected(const Vector& towardsEye, const Vector& normal) {
  return 2 * normal.dot(towardsEye) * normal - towardsEye;
}

/// Schlick's approximation of Fresnel reflection.
inline float schlick(float cosine) {
  const float m = std::min(std::max(1 - cosine, 0.0f), 1.0f);
  return m * m * m * m * m;
}

inline float smoothStep(float from, float to, float x) {
  const float t = std::min(std::max((x - from) / (to - from), 0.0f), 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace ifa::render
