// SPDX-License-Identifier: Apache-2.0
// Where and how an event of one simulation is seen in the world of another one: moved in the plane,
// and as one of its images under the body's symmetry group. docs/symmetry.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "connection/registration.h"
#include "model/rigid_state.h"

namespace ifa {

/// A motion seen with other names for the parts of a symmetric body, and where that takes a
/// reflection of the body, mirrored in the world's plane y = 0. Physics does not tell them apart.
struct SymmetryImage {
  bool mirrored = false;
  /// det(S) S for the element S of the group (principal frame).
  Eigen::Quaterniond relabelling = Eigen::Quaterniond::Identity();

  /// @param element  orthogonal, principal frame, of the body's symmetry group
  [[nodiscard]] static SymmetryImage of(const Eigen::Matrix3d& element);
  /// A position, velocity or impulse.
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector3d& v) const {
    return mirrored ? Eigen::Vector3d(v.x(), -v.y(), v.z()) : v;
  }
  /// A spin or angular impulse, which a mirror turns round as well.
  [[nodiscard]] Eigen::Vector3d axial(const Eigen::Vector3d& w) const {
    return mirrored ? Eigen::Vector3d(-w.x(), w.y(), -w.z()) : w;
  }
  /// R becomes R S, or M R S with the mirror M.
  [[nodiscard]] RigidState apply(const RigidState& state) const;
};

/// An image, then a motion of the plane.
struct Placement {
  PlanarTransform plane;
  SymmetryImage image;

  [[nodiscard]] RigidState apply(const RigidState& state) const {
    return plane.apply(image.apply(state));
  }
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector3d& v) const {
    return plane.turn() * image.direction(v);
  }
  [[nodiscard]] Eigen::Vector3d axial(const Eigen::Vector3d& w) const {
    return plane.turn() * image.axial(w);
  }
  /// What direction() makes this, and axial(): a mirror undoes itself.
  [[nodiscard]] Eigen::Vector3d directionFrom(const Eigen::Vector3d& placed) const {
    return image.direction(plane.turn().conjugate() * placed);
  }
  [[nodiscard]] Eigen::Vector3d axialFrom(const Eigen::Vector3d& placed) const {
    return image.axial(plane.turn().conjugate() * placed);
  }
  /// This one after `first`.
  [[nodiscard]] Placement after(const Placement& first) const;
};

}  // namespace ifa
