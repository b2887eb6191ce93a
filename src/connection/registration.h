// SPDX-License-Identifier: Apache-2.0
// Motions of the plane into itself, and the one that best lays one contact state over another.
// IFA 5.3.1, docs/method.md 4.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "model/rigid_state.h"

namespace ifa {

/// A turn about the plane's normal (z), then a shift within the plane. World frame.
struct PlanarTransform {
  double halfCosine = 1, halfSine = 0;  ///< of half the angle of the turn
  double x = 0, y = 0;                  ///< shift, m

  [[nodiscard]] Eigen::Quaterniond turn() const { return {halfCosine, 0, 0, halfSine}; }
  /// State after the motion of the plane: pose and velocities; heights stay.
  [[nodiscard]] RigidState apply(const RigidState& state) const;
  /// This one after `first`.
  [[nodiscard]] PlanarTransform after(const PlanarTransform& first) const;
};

/// A registration and what it leaves over.
struct Registration {
  PlanarTransform transform;
  double angle = 0;  ///< theta of eq. 4: between the orientations after it, rad, 0 to pi
};

/// The planar motion that lays `moved` over `onto`: centres of mass above one another, and the
/// smallest angle between the orientations (Shin et al. 2001). With r = q_onto q_moved^-1 =
/// (w, x, y, z) the turn is 2 atan2(z, w) and the angle left 2 acos sqrt(w^2 + z^2). Decision:
/// where w = z = 0 (one body stands on its head as seen from the other) every turn is as good, and
/// none is made.
[[nodiscard]] Registration registerState(const RigidState& moved, const RigidState& onto);

/// What of a state does not change under motions of the plane: seen from the body. Two states of
/// one key differ by a planar motion only, but for the height.
struct PlanarKey {
  Eigen::Vector3d up;               ///< u = R^-1 n, the plane's normal, unit
  Eigen::Vector3d velocity;         ///< R^-1 v, m/s
  Eigen::Vector3d angularVelocity;  ///< R^-1 omega, rad/s
};
[[nodiscard]] PlanarKey planarKey(const RigidState& state);

/// Angle between the plane's normals as two bodies see them: what registration leaves, rad. Good to
/// 1e-8 where the two are nearly the same.
[[nodiscard]] double angleBetween(const PlanarKey& a, const PlanarKey& b);

}  // namespace ifa
