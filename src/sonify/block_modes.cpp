// SPDX-License-Identifier: Apache-2.0
#include "sonify/block_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ifa {
namespace {

constexpr int kCount = BlockMode::kDegree + 1;
using Table = Eigen::Matrix<double, kCount, kCount>;

/// Legendre polynomials at x, each of mean square 1 over [-1, 1].
std::array<double, kCount> legendre(double x) {
  std::array<double, kCount> p{1, std::sqrt(3.0) * x};
  double before = 1, now = x;
  for (int n = 2; n < kCount; ++n) {
    const double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
    before = now;
    now = next;
    p[static_cast<std::size_t>(n)] = std::sqrt(2.0 * n + 1) * next;
  }
  return p;
}

/// Mean over [-1, 1] of a polynomial's derivative times another one: P_n' is the sum of
/// (2 k + 1) P_k over k = n - 1, n - 3...
Table slopes() {
  Table table = Table::Zero();
  for (int n = 0; n < kCount; ++n) {
    for (int k = n - 1; k >= 0; k -= 2) table(n, k) = std::sqrt((2.0 * n + 1) * (2.0 * k + 1));
  }
  return table;
}

/// Means over the block of products of derivatives along two axes, in units of its half sides.
class Overlaps {
 public:
  double operator()(const std::array<int, 3>& a, int alongA, const std::array<int, 3>& b,
                    int alongB) const {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const bool da = axis == alongA, db = axis == alongB;
      product *= da && db ? both_(a[i], b[i])
                 : da     ? one_(a[i], b[i])
                 : db     ? one_(b[i], a[i])
                          : static_cast<double>(a[i] == b[i]);
    }
    return product;
  }

 private:
  Table one_ = slopes();
  Table both_ = one_ * one_.transpose();
};

/// Elastic energy of two shapes together, over the mass: eigenvalues are squares of 2 pi f.
Eigen::MatrixXd stiffness(const Block& block) {
  const double lame = block.young * block.poisson / ((1 + block.poisson) * (1 - 2 * block.poisson));
  const double shear = block.young / (2 * (1 + block.poisson));
  const Eigen::Vector3d scale = 2 * block.sides.cwiseInverse();
  const auto& basis = BlockMode::basis();
  const Overlaps overlap;
  const auto count = static_cast<Eigen::Index>(basis.size());
  Eigen::MatrixXd matrix(3 * count, 3 * count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b < count; ++b) {
      Eigen::Matrix3d d;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          d(i, j) =
              scale(i) * scale(j) *
              overlap(basis[static_cast<std::size_t>(a)], i, basis[static_cast<std::size_t>(b)], j);
        }
      }
      matrix.block<3, 3>(3 * a, 3 * b) =
          lame * d + shear * d.transpose() + shear * d.trace() * Eigen::Matrix3d::Identity();
    }
  }
  return matrix / block.density;
}

}  // namespace

Block blockLike(const Body& body, const SoundMaterial& material) {
  const Eigen::Vector3d& moments = body.principalMoments;
  Block block;
  block.bodyFromBlock = body.bodyFromPrincipal;
  for (int i = 0; i < 3; ++i) {
    block.sides(i) = std::sqrt(6 * std::max(0.0, moments.sum() - 2 * moments(i)) / body.mass);
  }
  // A flat thing of no thickness at all would have no volume.
  block.sides = block.sides.cwiseMax(0.01 * block.sides.maxCoeff());
  block.density = body.mass / block.sides.prod();
  const double filled = std::min(1.0, block.density / material.density);
  block.young = material.young * filled * filled * filled;
  block.poisson = material.poisson;
  return block;
}

const std::vector<std::array<int, 3>>& BlockMode::basis() {
  static const auto kBasis = [] {
    std::vector<std::array<int, 3>> all;
    for (int l = 0; l <= kDegree; ++l) {
      for (int m = 0; l + m <= kDegree; ++m) {
        for (int n = 0; l + m + n <= kDegree; ++n) all.push_back({l, m, n});
      }
    }
    return all;
  }();
  return kBasis;
}

BlockMode::BlockMode(const Block& block, double frequency, Eigen::VectorXd coefficients)
    : half_(block.sides / 2),
      bodyFromBlock_(block.bodyFromBlock),
      frequency_(frequency),
      coefficients_(std::move(coefficients)) {
  constexpr int kGrid = 6;  // midpoints on each side
  double sum = 0, area = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double patch = block.sides(u) * block.sides(v) / (kGrid * kGrid);
    for (int k = 0; k < 2 * kGrid * kGrid; ++k) {
      Eigen::Vector3d unit;
      unit(axis) = k % 2 == 0 ? 1 : -1;
      const int column = k / 2 % kGrid, row = k / 2 / kGrid;
      unit(u) = (2 * column + 1.0) / kGrid - 1;
      unit(v) = (2 * row + 1.0) / kGrid - 1;
      const double across = shape(unit)(axis);
      sum += patch * across * across;
      area += patch;
    }
  }
  surfaceMotion_ = std::sqrt(sum / area);
}

Eigen::Vector3d BlockMode::shape(const Eigen::Vector3d& unit) const {
  const auto x = legendre(unit.x()), y = legendre(unit.y()), z = legendre(unit.z());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Index k = 0;
  for (const auto& [l, m, n] : basis()) {
    sum += x[static_cast<std::size_t>(l)] * y[static_cast<std::size_t>(m)] *
           z[static_cast<std::size_t>(n)] * coefficients_.segment<3>(3 * k++);
  }
  return sum;
}

Eigen::Vector3d BlockMode::shapeAt(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d unit = (bodyFromBlock_.transpose() * point).cwiseQuotient(half_);
  const Eigen::Vector3d inside =
      unit.cwiseMax(-Eigen::Vector3d::Ones()).cwiseMin(Eigen::Vector3d::Ones());
  return bodyFromBlock_ * shape(inside);
}

std::vector<BlockMode> blockModes(const Block& block, double highest) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness(block));
  const double toMass = 1 / std::sqrt(block.density * block.sides.prod());
  std::vector<BlockMode> modes;
  // The first six move the block as a whole.
  for (Eigen::Index k = 6; k < solver.eigenvalues().size(); ++k) {
    const double frequency =
        std::sqrt(std::max(0.0, solver.eigenvalues()(k))) / (2 * std::numbers::pi);
    if (frequency >= highest) break;
    modes.emplace_back(block, frequency, toMass * solver.eigenvectors().col(k));
  }
  return modes;
}

}  // namespace ifa
