// SPDX-License-Identifier: Apache-2.0
#include "body/symmetry.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "body/symmetry_name.h"

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Permutation = std::vector<std::size_t>;

/// Entries of a map between axes of different moments must be under this, and are made 0.
constexpr double kOtherAxis = 1e-2;
/// Sine of the angle between the two vertices that a map is made of, at least.
constexpr double kApart = 0.3;
/// Over the tolerance: maps made of two vertices only are this much worse than polished ones.
constexpr double kUnpolished = 4;
constexpr int kTightenings = 4;
constexpr std::size_t kMostOrder = 1024;

/// The nearest orthogonal matrix, by Newton's iteration.
Matrix3d orthogonal(Matrix3d m) {
  for (int i = 0; i < 30; ++i) {
    const Matrix3d next = 0.5 * (m + m.inverse().transpose());
    const double change = (next - m).cwiseAbs().maxCoeff();
    m = next;
    if (change < 1e-16) break;
  }
  return m;
}

/// Right-handed frame: along a, across it towards b.
Matrix3d frameOf(const Vector3d& a, const Vector3d& b) {
  const Vector3d x = a.normalized(), z = a.cross(b).normalized();
  Matrix3d frame;
  frame << x, z.cross(x), z;
  return frame;
}

/// A map of the body onto itself, and where it takes the vertices.
struct Map {
  Matrix3d matrix;
  Permutation to;
};

}  // namespace

/// One search at one tolerance.
class SymmetrySearch {
 public:
  SymmetrySearch(const Body& body, const SymmetryTolerance& tolerance)
      : moments_(body.principalMoments), equal_(tolerance.inertia * moments_.maxCoeff()) {
    for (const Vector3d& vertex : body.hull) {
      vertices_.emplace_back(body.bodyFromPrincipal.transpose() * vertex);
      radius_ = std::max(radius_, vertices_.back().norm());
    }
    near_ = tolerance.hull * radius_;
  }

  /// False where what was found is no group: some maps hold by the skin of their teeth.
  bool run(SymmetryGroup& group) {
    if (vertices_.size() < 4 || !choosePair()) return false;
    collect();
    return makeGroup(group);
  }

 private:
  /// Vertices as far from the centre as `vertex` is.
  [[nodiscard]] Permutation mates(std::size_t vertex) const {
    Permutation all;
    const double length = vertices_[vertex].norm();
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      if (std::abs(vertices_[i].norm() - length) <= 2 * near_) all.push_back(i);
    return all;
  }

  /// Two vertices with few mates whose images fix a map.
  bool choosePair() {
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> count;
    for (std::size_t i = 0; i < vertices_.size(); ++i) count.push_back(mates(i).size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (vertices_[i].norm() < kApart * radius_ || count[i] >= fewest) continue;
      first_ = i;
      fewest = count[i];
    }
    fewest = std::numeric_limits<std::size_t>::max();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const double apart = vertices_[first_].normalized().cross(vertices_[i]).norm();
      if (apart < kApart * radius_ || count[i] >= fewest) continue;
      second_ = i;
      fewest = count[i];
    }
    return fewest < std::numeric_limits<std::size_t>::max();
  }

  /// Every map that takes the two vertices to two others and passes.
  void collect() {
    const Matrix3d from = frameOf(vertices_[first_], vertices_[second_]);
    const double across = vertices_[first_].dot(vertices_[second_]);
    const Permutation firsts = mates(first_), seconds = mates(second_);
    for (const double hand : {1.0, -1.0}) {
      for (const std::size_t a : firsts) {
        for (const std::size_t b : seconds) {
          if (std::abs(vertices_[a].dot(vertices_[b]) - across) > 4 * near_ * radius_) continue;
          Matrix3d onto = frameOf(vertices_[a], vertices_[b]);
          onto.col(2) *= hand;
          add(onto * from.transpose());
        }
      }
    }
  }

  void add(const Matrix3d& rough) {
    Map map{rough, {}};
    if (maps_.size() >= kMostOrder || !fits(map, kUnpolished * near_)) return;
    map.matrix = polished(map.to);
    if (!sparesInertia(map.matrix) || !fits(map, near_)) return;
    const auto key = keyOf(map);
    if (numbers_.emplace(key, maps_.size()).second) maps_.push_back(std::move(map));
  }

  /// Sets where the vertices go; false where one goes nowhere, or two to one place.
  bool fits(Map& map, double tolerance) const {
    map.to.clear();
    std::vector<bool> taken(vertices_.size(), false);
    for (const Vector3d& vertex : vertices_) {
      const Vector3d image = map.matrix * vertex;
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const double distance = (vertices_[i] - image).squaredNorm();
        if (distance < least) std::tie(nearest, least) = std::pair(i, distance);
      }
      if (least > tolerance * tolerance || taken[nearest]) return false;
      taken[nearest] = true;
      map.to.push_back(nearest);
    }
    return true;
  }

  /// The best orthogonal map of the vertices onto those of `to` that leaves the axes of other
  /// moments alone.
  [[nodiscard]] Matrix3d polished(const Permutation& to) const {
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      sum += vertices_[to[i]] * vertices_[i].transpose();
    Matrix3d best = orthogonal(sum);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (otherMoments(i, j) && std::abs(best(i, j)) < kOtherAxis) best(i, j) = 0;
    return orthogonal(best);
  }

  [[nodiscard]] bool otherMoments(int i, int j) const {
    return std::abs(moments_[i] - moments_[j]) > equal_;
  }

  [[nodiscard]] bool sparesInertia(const Matrix3d& matrix) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (otherMoments(i, j) && matrix(i, j) != 0) return false;
    return true;
  }

  /// Where the two vertices go, and the hand, tell a map from all others.
  using Key = std::tuple<bool, std::size_t, std::size_t>;
  [[nodiscard]] Key keyOf(const Map& map) const {
    return {map.matrix.determinant() < 0, map.to[first_], map.to[second_]};
  }
  [[nodiscard]] std::size_t numberOf(const Map& a, const Map& b) const {
    const bool improper = (a.matrix.determinant() < 0) != (b.matrix.determinant() < 0);
    const auto at = numbers_.find({improper, a.to[b.to[first_]], a.to[b.to[second_]]});
    return at == numbers_.end() ? kMostOrder : at->second;
  }

  bool makeGroup(SymmetryGroup& group) {
    // The identity first; the rotations were found before the others.
    for (std::size_t i = 0; i < maps_.size(); ++i)
      if ((maps_[i].matrix - Matrix3d::Identity()).cwiseAbs().maxCoeff() < kOtherAxis)
        std::swap(maps_[0], maps_[i]);
    for (std::size_t i = 0; i < maps_.size(); ++i) numbers_[keyOf(maps_[i])] = i;
    const std::size_t order = maps_.size();
    group.products_.assign(order * order, 0);
    for (std::size_t a = 0; a < order; ++a) {
      for (std::size_t b = 0; b < order; ++b) {
        const std::size_t product = numberOf(maps_[a], maps_[b]);
        if (product == kMostOrder) return false;
        group.products_[a * order + b] = static_cast<std::uint16_t>(product);
      }
    }
    group.elements_.clear();
    for (const Map& map : maps_) group.elements_.push_back(map.matrix);
    group.rotations_ = static_cast<std::size_t>(std::count_if(
        maps_.begin(), maps_.end(), [](const Map& map) { return map.matrix.determinant() > 0; }));
    close(group);
    return order > 0 && stillFits(group);
  }

  /// Makes products of elements elements to the last bits: each becomes the mean of all products
  /// that ought to be it. What is left shrinks as its square.
  static void close(SymmetryGroup& group) {
    const std::size_t order = group.order();
    for (int round = 0; round < 3; ++round) {
      std::vector<Matrix3d> sums(order, Matrix3d::Zero());
      for (std::size_t a = 0; a < order; ++a)
        for (std::size_t b = 0; b < order; ++b)
          sums[group.product(a, b)] += group.elements_[a] * group.elements_[b];
      for (std::size_t a = 0; a < order; ++a)
        group.elements_[a] = orthogonal(sums[a] / static_cast<double>(order));
    }
    group.elements_[0].setIdentity();
  }

  [[nodiscard]] bool stillFits(const SymmetryGroup& group) const {
    for (std::size_t a = 0; a < group.order(); ++a)
      for (std::size_t i = 0; i < vertices_.size(); ++i)
        if ((group.elements_[a] * vertices_[i] - vertices_[maps_[a].to[i]]).norm() > 2 * near_)
          return false;
    return true;
  }

  std::vector<Vector3d> vertices_;  // principal frame
  Vector3d moments_;
  double radius_ = 0, near_ = 0, equal_ = 0;
  std::size_t first_ = 0, second_ = 0;
  std::vector<Map> maps_;
  std::map<Key, std::size_t> numbers_;

 public:
  static void name(SymmetryGroup& group) {
    group.axisOrder_ = highestAxis(group);
    group.name_ = schoenflies(group);
  }
};

SymmetryGroup::SymmetryGroup() : elements_{Matrix3d::Identity()}, products_{0}, name_("C1") {}

std::size_t SymmetryGroup::inverse(std::size_t element) const {
  std::size_t other = 0;
  while (product(element, other) != 0) ++other;
  return other;
}

SymmetryGroup findSymmetry(const Body& body, const SymmetryTolerance& tolerance) {
  SymmetryTolerance tighter = tolerance;
  for (int i = 0; i < kTightenings; ++i) {
    SymmetryGroup group;
    if (SymmetrySearch(body, tighter).run(group)) {
      SymmetrySearch::name(group);
      return group;
    }
    tighter.hull /= 4;
  }
  return {};
}

}  // namespace ifa
