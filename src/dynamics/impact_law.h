// SPDX-License-Identifier: Apache-2.0
// Newton restitution at every vertex that hits, without ever gaining energy.
#ifndef IFA_DYNAMICS_IMPACT_LAW_H
#define IFA_DYNAMICS_IMPACT_LAW_H

#include "dynamics/contact_solver.h"
#include "dynamics/lane_energy.h"

namespace ifa {

/// What an impact changes.
template <class R>
struct Impact {
  Vec<R> velocity{};  ///< world frame, m/s
  Vec<R> w{};         ///< body frame, rad/s
  Vec<R> impulse{};   ///< sum over all points, N s
};

template <class R>
Impact<R> select(const LaneMask<R>& mask, const Impact<R>& yes, const Impact<R>& no) {
  return {select(mask, yes.velocity, no.velocity), select(mask, yes.w, no.w),
          select(mask, yes.impulse, no.impulse)};
}

/// The law for one body before one impact.
template <class R>
class ImpactLaw {
 public:
  ImpactLaw(const BodyModel& body, const Rotation<R>& rotation, const Vec<R>& velocity,
            const Vec<R>& w)
      : body_(body), rotation_(rotation), velocity_(velocity), w_(w) {}

  /// Solves the impact of the points gathered in `solver` (here, gap, rate, r), whose impulses are
  /// of no use afterwards. Where friction would let full restitution gain energy, as much of it is
  /// taken as gains none.
  [[nodiscard]] Impact<R> solve(R restitution, ContactSolver<R>& solver) const {
    const R energy = kineticEnergy(body_, velocity_, w_);
    Impact<R> impact = solved(restitution, solver);
    const LaneMask<R> gains = energyOf(impact) > energy;
    if (!anyLane(gains)) return impact;
    setWhere(gains, impact, between(solved(R(0.0), solver), impact, energy));
    // Sweeps that have not settled may leave even a plastic impact above; rounding may as well.
    const R after = energyOf(impact);
    const LaneMask<R> above = after > energy;
    if (anyLane(above)) setWhere(above, impact, slowed(impact, energy / after));
    return impact;
  }

 private:
  /// Impulses are solved to this change of speed, m/s.
  static constexpr double kPrecision = 3e-4;

  [[nodiscard]] R energyOf(const Impact<R>& impact) const {
    return kineticEnergy(body_, impact.velocity, impact.w);
  }

  [[nodiscard]] Impact<R> solved(R restitution, ContactSolver<R>& solver) const {
    const R zero(0.0);
    for (int k = 0; k < solver.count; ++k) {
      ContactPoint<R>& p = solver.points[k];
      const LaneMask<R> bounces = p.rate < R(-body_.settings.bounceSpeed);
      p.target = {zero, zero, select(bounces, zero - restitution * p.rate, zero)};
      p.impulse = {};
    }
    solver.moment = solver.spinTarget = {};
    solver.rollingArm = R(body_.surface.rollingFriction);
    Impact<R> impact{velocity_, rotation_ * w_, {}};
    solver.solve(body_, WorldInertia<R>(body_, rotation_), body_.settings.impactIterations,
                 R(kPrecision * body_.mass), impact.velocity, impact.w);
    impact.w = rotation_.transposed(impact.w);
    impact.impulse = solver.total();
    return impact;
  }

  /// The point between a plastic impact, which gains nothing, and a full one, which does, that has
  /// energy `energy`.
  [[nodiscard]] Impact<R> between(const Impact<R>& plastic, const Impact<R>& full, R energy) const {
    const Impact<R> way = {full.velocity - plastic.velocity, full.w - plastic.w,
                           full.impulse - plastic.impulse};
    const R a = energyOf(way), c = energyOf(plastic) - energy;
    const R b = R(body_.mass) * dot(plastic.velocity, way.velocity) +
                R(body_.inertia.x) * plastic.w.x * way.w.x +
                R(body_.inertia.y) * plastic.w.y * way.w.y +
                R(body_.inertia.z) * plastic.w.z * way.w.z;
    // Energy along the way is a s^2 + b s + c, with c <= 0 and the whole above 0 at s = 1.
    const R zero(0.0);
    const R root = laneSqrt(laneMax(zero, b * b - R(4.0) * a * c)) - b;
    const R share = laneMax(zero, laneMin(R(1.0), root / (R(2.0) * a)));
    const R s = select(a > zero, share, zero);
    return {plastic.velocity + way.velocity * s, plastic.w + way.w * s,
            plastic.impulse + way.impulse * s};
  }

  /// With `share` of its energy, or a trifle less.
  [[nodiscard]] Impact<R> slowed(const Impact<R>& impact, R share) const {
    const R scale = laneSqrt(share) * R(1 - 1e-15);
    return {impact.velocity * scale, impact.w * scale,
            impact.impulse + impact.velocity * ((scale - R(1.0)) * R(body_.mass))};
  }

  const BodyModel& body_;
  const Rotation<R>& rotation_;
  const Vec<R>&velocity_, &w_;
};

}  // namespace ifa

#endif
