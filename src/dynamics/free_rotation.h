// SPDX-License-Identifier: Apache-2.0
// Torque-free rotation as a power series in time: accurate, without transcendental functions, the
// same bits everywhere. Euler's equations and q' = q (0, w) / 2 are bilinear, so their Taylor
// coefficients follow from Cauchy products (Jorba and Zou 2005, "A software package for the
// numerical integration of ODEs").
#pragma once

#include "dynamics/body_model.h"
#include "dynamics/lane.h"

namespace ifa {

/// Orientation and angular velocity in the body (principal) frame.
template <class R>
struct Spin {
  Quat<R> q;
  Vec<R> w;
};

/// Series of a torque-free rotation about its start; good for turns of up to about half a radian.
template <class R>
class FreeRotation {
 public:
  static constexpr int kOrder = 8;

  FreeRotation(const BodyModel& body, const Spin<R>& start) : isotropic_(body.isotropic) {
    q_[0] = start.q;
    w_[0] = start.w;
    for (int k = 0; k < kOrder; ++k) {
      const R share(1.0 / (k + 1));
      if (!isotropic_) w_[k + 1] = nextSpin(body, k, share);
      q_[k + 1] = nextTurn(k, R(0.5) * share);
    }
  }

  /// Orientation (unit) and angular velocity after `t` seconds.
  [[nodiscard]] Spin<R> at(R t) const {
    Spin<R> s{q_[kOrder], isotropic_ ? w_[0] : w_[kOrder]};
    for (int k = kOrder - 1; k >= 0; --k) {
      s.q = s.q * t + q_[k];
      if (!isotropic_) s.w = s.w * t + w_[k];
    }
    s.q = normalised(s.q);
    return s;
  }

 private:
  Vec<R> nextSpin(const BodyModel& body, int k, R share) const {
    Vec<R> sum{};
    for (int j = 0; j <= k; ++j) {
      const Vec<R>&a = w_[j], &b = w_[k - j];
      sum = sum + Vec<R>{a.y * b.z, a.z * b.x, a.x * b.y};
    }
    return {sum.x * R(body.euler.x) * share, sum.y * R(body.euler.y) * share,
            sum.z * R(body.euler.z) * share};
  }
  Quat<R> nextTurn(int k, R share) const {
    if (isotropic_) return timesPure(q_[k], w_[0]) * share;
    Quat<R> sum{};
    for (int j = 0; j <= k; ++j) sum = sum + timesPure(q_[j], w_[k - j]);
    return sum * share;
  }

  bool isotropic_;
  Quat<R> q_[kOrder + 1];
  Vec<R> w_[kOrder + 1];
};

/// Angular momentum, world frame, of a body-frame angular velocity.
template <class R>
Vec<R> angularMomentum(const BodyModel& body, const Rotation<R>& rotation, const Vec<R>& w) {
  return rotation *
         Vec<R>{w.x * R(body.inertia.x), w.y * R(body.inertia.y), w.z * R(body.inertia.z)};
}

/// The inverse: body-frame angular velocity of a world-frame angular momentum.
template <class R>
Vec<R> spinOfMomentum(const BodyModel& body, const Rotation<R>& rotation, const Vec<R>& momentum) {
  const Vec<R> l = rotation.transposed(momentum);
  return {l.x * R(body.inverseInertia.x), l.y * R(body.inverseInertia.y),
          l.z * R(body.inverseInertia.z)};
}

}  // namespace ifa
