// SPDX-License-Identifier: Apache-2.0
// Bodies made in memory, for tests that need no object file.
#pragma once

#include <algorithm>
#include <cmath>

#include "body/body.h"

namespace ifa {

/// Solid box with the given sides (m) and mass (kg), body frame along its sides.
inline Body makeBoxBody(const Eigen::Vector3d& sides, double mass) {
  Body body;
  body.definition.name = "box";
  body.mass = body.definition.mass = mass;
  const Eigen::Vector3d half = sides / 2;
  for (int corner = 0; corner < 8; ++corner) {
    body.hull.emplace_back((corner & 1 ? 1 : -1) * half.x(), (corner & 2 ? 1 : -1) * half.y(),
                           (corner & 4 ? 1 : -1) * half.z());
  }
  body.mesh.vertices = body.hull;
  const Eigen::Vector3d squares = sides.cwiseAbs2();
  body.principalMoments = mass / 12 * (Eigen::Vector3d::Constant(squares.sum()) - squares).eval();
  body.inertia = body.principalMoments.asDiagonal();
  body.radius = half.norm();
  body.size = sides.maxCoeff();
  return body;
}

/// Prism over a regular polygon of `sides` corners at `radius` (m), its axis along x, a face down;
/// moments of a solid cylinder.
inline Body makePrismBody(int sides, double radius, double length, double mass) {
  Body body;
  body.definition.name = "prism";
  body.mass = body.definition.mass = mass;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979323846 * (i + 0.5) / sides;
    for (const double x : {-length / 2, length / 2})
      body.hull.emplace_back(x, radius * std::sin(angle), -radius * std::cos(angle));
  }
  body.mesh.vertices = body.hull;
  const double across = mass * (3 * radius * radius + length * length) / 12;
  body.principalMoments = {mass * radius * radius / 2, across, across};
  body.inertia = body.principalMoments.asDiagonal();
  body.radius = std::hypot(radius, length / 2);
  body.size = std::max(length, 2 * radius);
  return body;
}

/// A die of 16 mm and 4.9 g.
inline Body makeDieBody() { return makeBoxBody(Eigen::Vector3d::Constant(0.016), 0.0049); }

}  // namespace ifa
