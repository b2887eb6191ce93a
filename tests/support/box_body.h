// SPDX-License-Identifier: Apache-2.0
// A box made in memory: the body of tests that need no object file.
#pragma once

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

/// A die of 16 mm and 4.9 g.
inline Body makeDieBody() { return makeBoxBody(Eigen::Vector3d::Constant(0.016), 0.0049); }

}  // namespace ifa
