// SPDX-License-Identifier: Apache-2.0
#include "body/symmetry_name.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "body/symmetry.h"

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSame = 1e-6;

/// Power at which an element becomes the identity.
std::size_t orderOf(const SymmetryGroup& group, std::size_t element) {
  std::size_t power = 1;
  for (std::size_t at = element; at != 0; at = group.product(at, element)) ++power;
  return power;
}

/// The longest of the vectors, made a unit.
Vector3d longest(const std::vector<Vector3d>& all) {
  const auto at = std::max_element(
      all.begin(), all.end(),
      [](const Vector3d& a, const Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
  return at->normalized();
}

/// Of a rotation that is not the identity: across all that it moves.
Vector3d axisOf(const Matrix3d& rotation) {
  const Matrix3d m = rotation - Matrix3d::Identity();
  const Vector3d a = m.row(0), b = m.row(1), c = m.row(2);
  return longest({a.cross(b), b.cross(c), c.cross(a)});
}

bool isReflection(const Matrix3d& m) {
  return (m * m - Matrix3d::Identity()).norm() < kSame && std::abs(m.trace() - 1) < kSame;
}

Vector3d normalOf(const Matrix3d& reflection) {
  const Matrix3d m = Matrix3d::Identity() - reflection;
  return longest({m.col(0), m.col(1), m.col(2)});
}

bool parallel(const Vector3d& a, const Vector3d& b) { return a.cross(b).norm() < kSame; }

/// Directions of the axes of the highest order.
std::vector<Vector3d> mainAxes(const SymmetryGroup& group, std::size_t highest) {
  std::vector<Vector3d> axes;
  for (std::size_t i = 1; i < group.rotations(); ++i) {
    if (orderOf(group, i) != highest) continue;
    const Vector3d axis = axisOf(group.elements()[i]);
    const bool known = std::any_of(axes.begin(), axes.end(),
                                   [&](const Vector3d& other) { return parallel(axis, other); });
    if (!known) axes.push_back(axis);
  }
  return axes;
}

/// The improper elements that tell groups of the same rotations apart.
struct Improper {
  bool inversion = false;
  bool across = false;  ///< a reflection whose normal is a main axis
  bool any = false;     ///< a reflection
};

Improper improperOf(const SymmetryGroup& group, const std::vector<Vector3d>& axes) {
  Improper found;
  for (std::size_t i = group.rotations(); i < group.order(); ++i) {
    const Matrix3d& m = group.elements()[i];
    found.inversion = found.inversion || (m + Matrix3d::Identity()).norm() < kSame;
    if (!isReflection(m)) continue;
    found.any = true;
    const Vector3d normal = normalOf(m);
    found.across = found.across || std::any_of(axes.begin(), axes.end(), [&](const Vector3d& axis) {
                     return parallel(normal, axis);
                   });
  }
  return found;
}

std::string cyclic(std::size_t n, bool improper, const Improper& kind) {
  if (!improper) return fmt::format("C{}", n);
  if (n == 1) return kind.inversion ? "Ci" : "Cs";
  if (kind.across) return fmt::format("C{}h", n);
  return kind.any ? fmt::format("C{}v", n) : fmt::format("S{}", 2 * n);
}

}  // namespace

std::size_t highestAxis(const SymmetryGroup& group) {
  std::size_t highest = 1;
  for (std::size_t i = 1; i < group.rotations(); ++i)
    highest = std::max(highest, orderOf(group, i));
  return highest;
}

std::string schoenflies(const SymmetryGroup& group) {
  const std::size_t n = highestAxis(group), rotations = group.rotations();
  const std::vector<Vector3d> axes = mainAxes(group, n);
  const bool improper = group.order() > rotations;
  const Improper kind = improperOf(group, axes);
  if (n == 3 && rotations == 12) return !improper ? "T" : kind.inversion ? "Th" : "Td";
  if (n == 4 && rotations == 24) return improper ? "Oh" : "O";
  if (n == 5 && rotations == 60) return improper ? "Ih" : "I";
  if (rotations == n) return cyclic(n, improper, kind);
  return fmt::format("D{}{}", n, !improper ? "" : kind.across ? "h" : "d");
}

}  // namespace ifa
