// SPDX-License-Identifier: Apache-2.0
#include "body/mass_properties.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace ifa {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d MassProperties::inertia() const {
  return covariance.trace() * Matrix3d::Identity() - covariance;
}

namespace {

// Moments about the middle of the bounding box: no digits are lost when a mesh lies far from its
// file's origin.
Vector3d middleOf(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : mesh.vertices) box.extend(vertex);
  return box.isEmpty() ? Vector3d::Zero() : Vector3d(box.center());
}

// Sums over the triangles of a simplex's mass, its first and its second moments about `origin`,
// where a simplex of n points has the second moment m / (n (n + 1)) (sum p p^T + s s^T), s = sum p.
template <class SimplexMass>
MassProperties integrate(const Mesh& mesh, double points, SimplexMass simplexMass) {
  const Vector3d origin = middleOf(mesh);
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const auto& triangle : mesh.triangles) {
    std::array<Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh.vertices[static_cast<std::size_t>(triangle[i])] - origin;
    }
    const double m = simplexMass(p[0], p[1], p[2]);
    const Vector3d sum = p[0] + p[1] + p[2];
    mass += m;
    first += m / points * sum;
    second += m / (points * (points + 1)) *
              (p[0] * p[0].transpose() + p[1] * p[1].transpose() + p[2] * p[2].transpose() +
               sum * sum.transpose());
  }
  MassProperties all;
  all.mass = mass;
  if (mass == 0) return all;
  const Vector3d centre = first / mass;
  all.centre = origin + centre;
  all.covariance = second - mass * centre * centre.transpose();
  return all;
}

}  // namespace

MassProperties solidProperties(const Mesh& mesh) {
  // Tetrahedra of the origin and a triangle.
  return integrate(mesh, 4, [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return a.dot(b.cross(c)) / 6;
  });
}

MassProperties shellProperties(const Mesh& mesh) {
  return integrate(mesh, 3, [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return (b - a).cross(c - a).norm() / 2;
  });
}

MassProperties scaledMass(MassProperties properties, double factor) {
  properties.mass *= factor;
  properties.covariance *= factor;
  return properties;
}

MassProperties combined(const MassProperties& a, const MassProperties& b) {
  MassProperties all;
  all.mass = a.mass + b.mass;
  if (all.mass == 0) return all;
  all.centre = (a.mass * a.centre + b.mass * b.centre) / all.mass;
  const Vector3d apart = a.centre - b.centre;
  all.covariance =
      a.covariance + b.covariance + a.mass * b.mass / all.mass * apart * apart.transpose();
  return all;
}

namespace {

constexpr double kEqualMoments = 1e-6;  ///< relative to the largest moment

// Right-handed frame about the unit vector `axis`, its first vector as near as can be to one of the
// body's axes.
Matrix3d frameAbout(const Vector3d& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vector3d beside = (Vector3d::Unit(least) - axis * axis[least]).normalized();
  Matrix3d frame;
  frame << beside, axis.cross(beside), axis;
  return frame;
}

// Of the two directions of an axis, the one whose largest component is positive.
Vector3d towardsPositive(const Vector3d& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vector3d(-axis) : axis;
}

bool nearlyDiagonal(const Matrix3d& inertia, double slack) {
  return std::max({std::abs(inertia(0, 1)), std::abs(inertia(0, 2)), std::abs(inertia(1, 2))}) <
         slack;
}

// The body's own axes, ordered by their moments; equal moments keep the order x, y, z.
PrincipalFrame alongOwnAxes(const Matrix3d& inertia, double slack) {
  std::array<Eigen::Index, 3> order = {0, 1, 2};
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i + 1 < 3; ++i) {
      if (inertia(order[i], order[i]) > inertia(order[i + 1], order[i + 1]) + slack) {
        std::swap(order[i], order[i + 1]);
      }
    }
  }
  PrincipalFrame frame;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index axis = order[static_cast<std::size_t>(i)];
    frame.moments[i] = inertia(axis, axis);
    frame.bodyFromPrincipal.col(i) = Vector3d::Unit(axis);
  }
  if (frame.bodyFromPrincipal.determinant() < 0) frame.bodyFromPrincipal.col(2) *= -1;
  std::sort(frame.moments.data(), frame.moments.data() + 3);
  return frame;
}

}  // namespace

PrincipalFrame principalFrame(const Matrix3d& inertia) {
  const double slack = kEqualMoments * inertia.diagonal().maxCoeff();
  if (nearlyDiagonal(inertia, slack)) return alongOwnAxes(inertia, slack);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
  PrincipalFrame frame;
  frame.moments = solver.eigenvalues();
  const Matrix3d& axes = solver.eigenvectors();
  const bool lowerEqual = frame.moments[1] - frame.moments[0] < slack;
  const bool upperEqual = frame.moments[2] - frame.moments[1] < slack;
  if (lowerEqual) {
    frame.bodyFromPrincipal = frameAbout(towardsPositive(axes.col(2)));
  } else if (upperEqual) {
    const Matrix3d about = frameAbout(towardsPositive(axes.col(0)));
    frame.bodyFromPrincipal << about.col(2), about.col(0), about.col(1);
  } else {
    const Vector3d x = towardsPositive(axes.col(0)), y = towardsPositive(axes.col(1));
    frame.bodyFromPrincipal << x, y, x.cross(y);
  }
  return frame;
}

}  // namespace ifa
