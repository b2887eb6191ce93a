// SPDX-License-Identifier: Apache-2.0
// Torque-free rotation, with the same bits everywhere.
#ifndef IFA_DYNAMICS_FREE_ROTATION_H
#define IFA_DYNAMICS_FREE_ROTATION_H

#include "dynamics/body_model.h"
#include "dynamics/lane.h"
#include "dynamics/lane_trigonometry.h"

namespace ifa {

/// Orientation and angular velocity in the body (principal) frame.
template <class R>
struct Spin {
  Quat<R> q;
  Vec<R> w;
};

/// Hamilton product.
template <class R>
Quat<R> operator*(const Quat<R>& a, const Quat<R>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Turn by the rotation vector `v`, rad.
template <class R>
Quat<R> turnBy(const Vec<R>& v) {
  const R angle = laneSqrt(dot(v, v));
  const SinCos<R> half = laneSinCos<R>(angle * R(0.5));
  const R scale = half.sine / laneMax(angle, R(1e-150));
  return {half.cosine, v.x * scale, v.y * scale, v.z * scale};
}

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

/// A torque-free rotation from its start on. Closed form where all or two moments are equal: a turn
/// about the angular momentum and one about the axis of symmetry. Else a power series (Euler's
/// equations and q' = q (0, w) / 2 are bilinear, so Taylor coefficients follow from Cauchy
/// products; Jorba and Zou 2005), good for turns of up to KernelSettings::segmentAngle.
template <class R>
class FreeRotation {
 public:
  static constexpr int kOrder = 10;

  FreeRotation(const BodyModel& body, const Spin<R>& start) : body_(body), start_(start) {
    if (body.isotropic) return;
    if (body.symmetryAxis >= 0) {
      prepareSymmetric();
    } else {
      prepareSeries();
    }
  }

  /// Orientation (unit) and angular velocity after `t` seconds.
  [[nodiscard]] Spin<R> at(R t) const {
    if (body_.isotropic) return {normalised(start_.q * turnBy<R>(start_.w * t)), start_.w};
    if (body_.symmetryAxis >= 0) return symmetricAt(t);
    Spin<R> s{q_[kOrder], w_[kOrder]};
    for (int k = kOrder - 1; k >= 0; --k) {
      s.q = s.q * t + q_[k];
      s.w = s.w * t + w_[k];
    }
    s.q = normalised(s.q);
    return s;
  }

 private:
  void prepareSymmetric() {
    const int k = body_.symmetryAxis;
    const double across = k == 0 ? body_.inertia.y : body_.inertia.x;
    const double along = k == 0 ? body_.inertia.x : body_.inertia.z;
    const R about = k == 0 ? start_.w.x : start_.w.z;
    relative_ = about * R(1 - along / across);
    precession_ = angularMomentum(body_, Rotation<R>(start_.q), start_.w) * R(1 / across);
  }

  [[nodiscard]] Spin<R> symmetricAt(R t) const {
    const SinCos<R> half = laneSinCos<R>(relative_ * t * R(0.5));
    const R c = half.cosine * half.cosine - half.sine * half.sine;
    const R s = R(2.0) * half.sine * half.cosine;
    const R zero(0.0);
    const bool first = body_.symmetryAxis == 0;
    const Quat<R> own = first ? Quat<R>{half.cosine, half.sine, zero, zero}
                              : Quat<R>{half.cosine, zero, zero, half.sine};
    const Vec<R>& w = start_.w;
    const Vec<R> turned = first ? Vec<R>{w.x, w.y * c + w.z * s, w.z * c - w.y * s}
                                : Vec<R>{w.x * c + w.y * s, w.y * c - w.x * s, w.z};
    return {normalised(turnBy<R>(precession_ * t) * start_.q * own), turned};
  }

  void prepareSeries() {
    q_[0] = start_.q;
    w_[0] = start_.w;
    for (int k = 0; k < kOrder; ++k) {
      const R share(1.0 / (k + 1));
      Vec<R> spin{};
      Quat<R> turn{};
      for (int j = 0; j <= k; ++j) {
        const Vec<R>&a = w_[j], &b = w_[k - j];
        spin = spin + Vec<R>{a.y * b.z, a.z * b.x, a.x * b.y};
        turn = turn + timesPure(q_[j], b);
      }
      w_[k + 1] = {spin.x * R(body_.euler.x) * share, spin.y * R(body_.euler.y) * share,
                   spin.z * R(body_.euler.z) * share};
      q_[k + 1] = turn * (R(0.5) * share);
    }
  }

  const BodyModel& body_;
  Spin<R> start_;
  R relative_{};         ///< rad/s, of the body about its axis against the precession
  Vec<R> precession_{};  ///< rad/s, world frame
  Quat<R> q_[kOrder + 1];
  Vec<R> w_[kOrder + 1];
};

}  // namespace ifa

#endif
