// SPDX-License-Identifier: Apache-2.0
// The symmetry group of a body as physics sees it: of its hull, its inertia and its centre of mass.
// docs/symmetry.md.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "body/body.h"

namespace ifa {

/// How far a body may be from symmetric.
struct SymmetryTolerance {
  /// Of a hull vertex from the place of another one's image, over the radius. Default: what
  /// Body::tolerance() is made of, a tenth of it: nobody sees it, and the audit allows ten times.
  double hull = 1e-4;
  /// Difference of two principal moments that count as equal, over the largest.
  double inertia = 1e-4;
};

/// A finite group of orthogonal maps of a body onto itself. Bodies of revolution have that of the
/// polygon which stands for their circle. Immutable once found; share it between threads.
class SymmetryGroup {
 public:
  /// Of a body without symmetry.
  SymmetryGroup();

  /// Rotations first, the identity before all. Principal frame, about the centre of mass; products
  /// of elements are elements, to the last few bits.
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& elements() const& { return elements_; }
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& elements() const&& = delete;
  [[nodiscard]] std::size_t order() const { return elements_.size(); }
  /// How many are rotations; the others are improper (rotations with a reflection).
  [[nodiscard]] std::size_t rotations() const { return rotations_; }
  [[nodiscard]] bool isRotation(std::size_t element) const { return element < rotations_; }
  /// Number of elements()[a] * elements()[b].
  [[nodiscard]] std::size_t product(std::size_t a, std::size_t b) const {
    return products_[a * order() + b];
  }
  [[nodiscard]] std::size_t inverse(std::size_t element) const;
  /// Schoenflies' symbol: C1, Cs, Ci, Cn, Cnv, Cnh, Sn, Dn, Dnd, Dnh, T, Td, Th, O, Oh, I, Ih, n in
  /// figures.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Order of the axis of the highest order, 1 where there is none.
  [[nodiscard]] std::size_t axisOrder() const { return axisOrder_; }
  /// Decision: an axis of 12 or more turns is a circle that was drawn with corners.
  [[nodiscard]] bool nearlyOfRevolution() const { return axisOrder_ >= 12; }

 private:
  friend class SymmetrySearch;
  std::vector<Eigen::Matrix3d> elements_;
  std::vector<std::uint16_t> products_;
  std::size_t rotations_ = 1, axisOrder_ = 1;
  std::string name_;
};

/// The group of the body: every orthogonal map that takes each vertex of the hull to within
/// tolerance of another one, and the inertia tensor to itself. The mesh has no say: physics does
/// not see it. Milliseconds; less than a second for hulls of 512 vertices on one sphere. The same
/// elements in the same order everywhere.
[[nodiscard]] SymmetryGroup findSymmetry(const Body& body, const SymmetryTolerance& tolerance = {});

}  // namespace ifa
