// SPDX-License-Identifier: Apache-2.0
#include "connection/placement.h"

#include <Eigen/LU>

namespace ifa {

SymmetryImage SymmetryImage::of(const Eigen::Matrix3d& element) {
  const bool improper = element.determinant() < 0;
  const Eigen::Matrix3d rotation = improper ? Eigen::Matrix3d(-element) : element;
  return {improper, Eigen::Quaterniond(rotation).normalized()};
}

RigidState SymmetryImage::apply(const RigidState& state) const {
  RigidState seen;
  seen.position = direction(state.position);
  seen.velocity = direction(state.velocity);
  seen.angularVelocity = axial(state.angularVelocity);
  seen.orientation = state.orientation * relabelling;
  // M R S = (-M) R (-S), and -M is half a turn about y.
  if (mirrored) seen.orientation = Eigen::Quaterniond(0, 0, 1, 0) * seen.orientation;
  return seen;
}

/// A mirror in y = 0 takes a turn to the turn the other way, and so its shift.
Placement Placement::after(const Placement& first) const {
  PlanarTransform moved = first.plane;
  if (image.mirrored) {
    moved.halfSine = -moved.halfSine;
    moved.y = -moved.y;
  }
  return {plane.after(moved),
          {image.mirrored != first.image.mirrored,
           (first.image.relabelling * image.relabelling).normalized()}};
}

}  // namespace ifa
