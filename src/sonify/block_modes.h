// SPDX-License-Identifier: Apache-2.0
// Vibrations of a free elastic block: what a body rings with (docs/sonify.md).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "body/body.h"
#include "sonify/sound_material.h"

namespace ifa {

/// A block that vibrates nearly as a body does. Its axes are the body's principal ones.
struct Block {
  Eigen::Vector3d sides = Eigen::Vector3d::Ones();  ///< m
  Eigen::Matrix3d bodyFromBlock = Eigen::Matrix3d::Identity();
  double young = 0;    ///< Pa
  double poisson = 0;  ///< of transverse contraction
  double density = 0;  ///< kg/m^3
};

/// The even block that has the body's mass and moments of inertia.
/// Decision: a body that is lighter than that block would be is hollow, and bends in its
/// walls: Young's modulus is reduced by the cube of what is filled, as of a honeycomb across its
/// cells (Gibson and Ashby 1997).
[[nodiscard]] Block blockLike(const Body& body, const SoundMaterial& material);

/// One mode, its shape normalised to the mass: the kinetic energy is half its squared velocity.
class BlockMode {
 public:
  /// Degree of the polynomials of which shapes are made.
  static constexpr int kDegree = 6;
  /// Legendre polynomials, normalised over the block, of a total degree up to kDegree.
  static const std::vector<std::array<int, 3>>& basis();

  BlockMode(const Block& block, double frequency, Eigen::VectorXd coefficients);

  [[nodiscard]] double frequency() const { return frequency_; }  ///< Hz
  /// Displacement at a point of the block (body frame, m; beyond it: at its edge), in the body
  /// frame; 1/sqrt(kg).
  [[nodiscard]] Eigen::Vector3d shapeAt(const Eigen::Vector3d& point) const;
  /// Root of the mean square of the displacement along the normal over the surface, 1/sqrt(kg).
  [[nodiscard]] double surfaceMotion() const { return surfaceMotion_; }

 private:
  [[nodiscard]] Eigen::Vector3d shape(const Eigen::Vector3d& unit) const;

  Eigen::Vector3d half_;
  Eigen::Matrix3d bodyFromBlock_;
  double frequency_;
  Eigen::VectorXd coefficients_;  ///< for each of the basis, x, y and z
  double surfaceMotion_ = 0;
};

/// Modes under `highest` (Hz) in order of frequency, by Rayleigh and Ritz's method with polynomials
/// as of resonant ultrasound spectroscopy (Visscher et al. 1991). Without the rigid ones.
[[nodiscard]] std::vector<BlockMode> blockModes(const Block& block, double highest);

}  // namespace ifa
