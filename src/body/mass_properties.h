// SPDX-License-Identifier: Apache-2.0
// Mass, centre of mass and inertia of a mesh, and the principal frame.
#pragma once

#include <Eigen/Core>

#include "body/body.h"

namespace ifa {

/// First and second moments of mass.
struct MassProperties {
  double mass = 0;                                       ///< kg (m^3 or m^2 at unit density)
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();      ///< centre of mass, m
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< integral of r r^T about the centre

  /// Inertia tensor about the centre, the mesh's axes.
  [[nodiscard]] Eigen::Matrix3d inertia() const;
};

/// Of the solid that a closed mesh bounds, at density 1: signed tetrahedra, exact for polyhedra.
/// Negative mass for a mesh that is inside out.
[[nodiscard]] MassProperties solidProperties(const Mesh& mesh);

/// Of the mesh as a thin sheet, at 1 kg/m^2.
[[nodiscard]] MassProperties shellProperties(const Mesh& mesh);

/// The same thing made denser or lighter by `factor`.
[[nodiscard]] MassProperties scaledMass(MassProperties properties, double factor);

/// Two rigidly joined things as one.
[[nodiscard]] MassProperties combined(const MassProperties& a, const MassProperties& b);

/// Principal moments, ascending, and the rotation to the body's axes from the principal ones.
struct PrincipalFrame {
  Eigen::Vector3d moments = Eigen::Vector3d::Ones();
  Eigen::Matrix3d bodyFromPrincipal = Eigen::Matrix3d::Identity();
};

/// Decision: moments within 1e-6 of each other count as equal (meshes come in single precision),
/// and equal moments get axes along the body's own as far as that is possible, so that the frame
/// of a die or a cylinder does not hang on the last bits of its mesh.
[[nodiscard]] PrincipalFrame principalFrame(const Eigen::Matrix3d& inertia);

}  // namespace ifa
