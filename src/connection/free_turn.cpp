// SPDX-License-Identifier: Apache-2.0
#include "connection/free_turn.h"

#include <cmath>

#include "dynamics/flight_path.h"

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Vec3 = Vec<double>;

/// How the end depends on the first angular velocity, column by column.
struct Variation {
  Vec3 spin[3];  ///< of the angular velocity
  Vec3 turn[3];  ///< of the orientation
};

/// Taylor series of the variational equation over one segment.
class VariationSeries {
 public:
  VariationSeries(const BodyModel& model, const Vec3& w) : euler_(model.euler) {
    w_[0] = w;
    for (int k = 0; k < kOrder; ++k) {
      Vec3 sum{};
      for (int j = 0; j <= k; ++j) sum = sum + halfProduct(w_[j], w_[k - j]);
      w_[k + 1] = scaled(sum, 1.0 / (k + 1));
    }
  }

  void advance(Vec3& spin, Vec3& turn, double t) const {
    Vec3 dw[kOrder + 1], e[kOrder + 1];
    dw[0] = spin;
    e[0] = turn;
    for (int k = 0; k < kOrder; ++k) {
      Vec3 ofSpin{}, ofTurn = dw[k];
      for (int j = 0; j <= k; ++j) {
        ofSpin = ofSpin + halfProduct(dw[j], w_[k - j]) + halfProduct(w_[k - j], dw[j]);
        ofTurn = ofTurn + cross(e[j], w_[k - j]);
      }
      dw[k + 1] = scaled(ofSpin, 1.0 / (k + 1));
      e[k + 1] = ofTurn * (1.0 / (k + 1));
    }
    spin = dw[kOrder];
    turn = e[kOrder];
    for (int k = kOrder - 1; k >= 0; --k) {
      spin = spin * t + dw[k];
      turn = turn * t + e[k];
    }
  }

 private:
  static constexpr int kOrder = 7;

  static Vec3 halfProduct(const Vec3& a, const Vec3& b) {
    return {a.y * b.z, a.z * b.x, a.x * b.y};
  }
  [[nodiscard]] Vec3 scaled(const Vec3& v, double share) const {
    return {v.x * euler_.x * share, v.y * euler_.y * share, v.z * euler_.z * share};
  }

  Vec3 euler_;
  Vec3 w_[kOrder + 1];
};

Matrix3d matrix(const Rotation<double>& r) {
  Matrix3d m;
  for (int i = 0; i < 3; ++i) m.row(i) << r.rows[i].x, r.rows[i].y, r.rows[i].z;
  return m;
}

/// Left Jacobian of the rotation by `v`: small turn (world frame) per change of `v`.
Matrix3d leftJacobian(const Vec3& v) {
  const double angle2 = dot(v, v), angle = std::sqrt(angle2);
  Matrix3d hat;
  hat << 0, -v.z, v.y, v.z, 0, -v.x, -v.y, v.x, 0;
  if (angle < 1e-4) return Matrix3d::Identity() + 0.5 * hat + hat * hat / 6;
  const SinCos<double> turned = laneSinCos(angle);
  const double c = (1 - turned.cosine) / angle2, s = (1 - turned.sine / angle) / angle2;
  return Matrix3d::Identity() + c * hat + s * hat * hat;
}

/// A turn about the angular momentum after one about the axis of symmetry: the slopes of both.
Matrix3d closedSlope(const BodyModel& model, const Spin<double>& start, const Quat<double>& end,
                     double duration) {
  const Rotation<double> first(start.q);
  const bool alongX = model.symmetryAxis == 0;
  const double across = alongX ? model.inertia.y : model.inertia.x;
  const double along = alongX ? model.inertia.x : model.inertia.z;
  const Vec3 turn = angularMomentum(model, first, start.w) * (duration / across);
  const Eigen::Vector3d moments(model.inertia.x, model.inertia.y, model.inertia.z);
  Matrix3d slope = matrix(Rotation<double>(end)).transpose() * leftJacobian(turn) * matrix(first) *
                   (moments * (duration / across)).asDiagonal();
  if (model.isotropic) return slope;
  const int axis = alongX ? 0 : 2;
  slope(axis, axis) += duration * (1 - along / across);
  return slope;
}

int piecesOf(const BodyModel& model, const Spin<double>& start, double duration) {
  if (closedForm(model)) return 1;
  const double rate = std::sqrt(dot(start.w, start.w));
  return static_cast<int>(duration * rate / model.settings.segmentAngle) + 1;
}

}  // namespace

FreeTurn freeTurn(const BodyModel& model, const Spin<double>& start, double duration) {
  const int pieces = piecesOf(model, start, duration);
  FreeTurn turn{start, {}};
  for (int i = 0; i < pieces; ++i) {
    turn.end = FreeRotation<double>(model, turn.end).at(duration / pieces);
  }
  return turn;
}

FreeTurn freeTurnWithSlope(const BodyModel& model, const Spin<double>& start, double duration) {
  FreeTurn turn{start, {}};
  if (closedForm(model)) {
    turn = freeTurn(model, start, duration);
    turn.slope = closedSlope(model, start, turn.end.q, duration);
    return turn;
  }
  const int pieces = piecesOf(model, start, duration);
  const double step = duration / pieces;
  Variation now{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}};
  for (int i = 0; i < pieces; ++i) {
    const VariationSeries series(model, turn.end.w);
    for (int c = 0; c < 3; ++c) series.advance(now.spin[c], now.turn[c], step);
    turn.end = FreeRotation<double>(model, turn.end).at(step);
  }
  for (int c = 0; c < 3; ++c) turn.slope.col(c) << now.turn[c].x, now.turn[c].y, now.turn[c].z;
  return turn;
}

}  // namespace ifa
