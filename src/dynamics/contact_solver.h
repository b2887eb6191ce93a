// SPDX-License-Identifier: Apache-2.0
// Impulses at the touching vertices: non-penetration, restitution and Coulomb friction by block
// Gauss-Seidel with accumulated, warm-started impulses. A point that sticks is solved exactly at
// each visit; one that slides or parts by projection, normal first. Rolling and spinning friction
// are moments limited by the normal impulse, relaxed along.
#ifndef IFA_DYNAMICS_CONTACT_SOLVER_H
#define IFA_DYNAMICS_CONTACT_SOLVER_H

#include <algorithm>

#include "dynamics/body_model.h"
#include "dynamics/lane.h"

namespace ifa {

/// Inverse inertia in the world frame, symmetric.
template <class R>
struct WorldInertia {
  R xx, xy, xz, yy, yz, zz;
  bool isotropic;

  WorldInertia(const BodyModel& body, const Rotation<R>& rotation) : isotropic(body.isotropic) {
    const R a(body.inverseInertia.x);
    if (body.isotropic) {
      xx = yy = zz = a;
      xy = xz = yz = R(0.0);
      return;
    }
    const R b(body.inverseInertia.y), c(body.inverseInertia.z);
    const auto& r = rotation.rows;
    const auto entry = [&](int i, int j) {
      return a * r[i].x * r[j].x + b * r[i].y * r[j].y + c * r[i].z * r[j].z;
    };
    xx = entry(0, 0);
    xy = entry(0, 1);
    xz = entry(0, 2);
    yy = entry(1, 1);
    yz = entry(1, 2);
    zz = entry(2, 2);
  }
  [[nodiscard]] Vec<R> operator*(const Vec<R>& v) const {
    if (isotropic) return v * xx;
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }
};

/// One touching vertex, in each lane its own.
template <class R>
struct ContactPoint {
  LaneMask<R> here{};                    ///< lanes that have it; in others its impulse is 0
  Vec<R> place{};                        ///< body frame, m
  R gap{}, rate{};                       ///< height, m, and its rate, m/s, where the step begins
  Vec<R> r{};                            ///< from the centre of mass, world frame, m
  Vec<R> target{};                       ///< velocity of a point that sticks; z is the least, m/s
  Vec<R> impulse{};                      ///< accumulated, N s
  Vec<R> turnX{}, turnY{}, turnZ{};      ///< change of spin by a unit impulse along each axis
  R massX{}, massY{}, massZ{};           ///< effective masses along each axis, kg
  R lessX{}, lessY{};                    ///< friction that stops what a unit normal impulse adds
  R xx{}, xy{}, xz{}, yy{}, yz{}, zz{};  ///< inverse of the 3 x 3 inverse mass at the point, kg
};

/// Up to kMaxPoints contacts of one body with the ground, and the solver for their impulses.
template <class R>
class ContactSolver {
 public:
  static constexpr int kMaxPoints = 8;

  int count = 0;  ///< of the lane that has most
  ContactPoint<R> points[kMaxPoints];
  Vec<R> moment{};      ///< of rolling (x, y) and spinning (z) friction, accumulated, N m s
  Vec<R> spinTarget{};  ///< angular velocity that this friction tends to, rad/s
  R rollingArm{};       ///< of rolling friction, m

  /// Changes `velocity` and `spin` (world frame) so that every point's normal velocity is at least
  /// its target and friction opposes sliding, rolling and spinning. Starts from the points'
  /// impulses and from `moment`; leaves impulses that are `precision` (N s) from settled. A lane
  /// that has settled is left as it is while others have not.
  void solve(const BodyModel& body, const WorldInertia<R>& inverse, int sweeps, R precision,
             Vec<R>& velocity, Vec<R>& spin) {
    const bool rolls = body.surface.rollingFriction > 0 || body.surface.spinningFriction > 0;
    for (int k = 0; k < count; ++k) {
      prepare(body, inverse, points[k]);
      apply(body, lanesWith(k), points[k], points[k].impulse, velocity, spin);
    }
    if (rolls) spin = spin + inverse * moment;
    LaneMask<R> live(true);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      R change(0.0);
      for (int k = 0; k < count; ++k) {
        const LaneMask<R> moves = live & lanesWith(k);
        if (!anyLane(moves)) continue;
        change = laneMax(change, relax(body, moves, points[k], velocity, spin));
      }
      if (rolls) brake(body, inverse, live, spin);
      live = live & (change > precision);
      if (!anyLane(live)) break;
    }
  }

  /// Sum of all angular impulses about the centre of mass, world frame, N m s.
  [[nodiscard]] Vec<R> totalTurn() const {
    Vec<R> sum = moment;
    for (int k = 0; k < count; ++k) {
      setWhere(lanesWith(k), sum, sum + cross(points[k].r, points[k].impulse));
    }
    return sum;
  }
  /// Sum of all impulses, world frame, N s.
  [[nodiscard]] Vec<R> total() const {
    Vec<R> sum{};
    for (int k = 0; k < count; ++k) setWhere(lanesWith(k), sum, sum + points[k].impulse);
    return sum;
  }

 private:
  /// Lanes that have point `k`: a lane on its own has all of `count`.
  [[nodiscard]] LaneMask<R> lanesWith([[maybe_unused]] int k) const {
    if constexpr (LaneTraits<R>::kLanes == 1) {
      return LaneMask<R>(true);
    } else {
      return points[k].here;
    }
  }

  /// Of a body whose moments are all equal half of the numbers are 0.
  static void turns(const WorldInertia<R>& inverse, ContactPoint<R>& p) {
    if (inverse.isotropic) {
      const R zero(0.0);
      const Vec<R> arm = p.r * inverse.xx;
      p.turnX = {zero, arm.z, zero - arm.y};
      p.turnY = {zero - arm.z, zero, arm.x};
      p.turnZ = {arm.y, zero - arm.x, zero};
      return;
    }
    const Vec<R> a = {inverse.xx, inverse.xy, inverse.xz}, b = {inverse.xy, inverse.yy, inverse.yz};
    const Vec<R> c = {inverse.xz, inverse.yz, inverse.zz};
    p.turnX = b * p.r.z - c * p.r.y;
    p.turnY = c * p.r.x - a * p.r.z;
    p.turnZ = a * p.r.y - b * p.r.x;
  }

  static void prepare(const BodyModel& body, const WorldInertia<R>& inverse, ContactPoint<R>& p) {
    const R inverseMass(body.inverseMass), one(1.0);
    turns(inverse, p);
    // Change of the point's velocity by unit impulses: a symmetric matrix.
    const R axx = inverseMass + p.turnX.y * p.r.z - p.turnX.z * p.r.y;
    const R ayy = inverseMass + p.turnY.z * p.r.x - p.turnY.x * p.r.z;
    const R azz = inverseMass + p.turnZ.x * p.r.y - p.turnZ.y * p.r.x;
    const R axy = p.turnX.z * p.r.x - p.turnX.x * p.r.z;
    const R axz = p.turnX.x * p.r.y - p.turnX.y * p.r.x;
    const R ayz = p.turnY.x * p.r.y - p.turnY.y * p.r.x;
    const R xy = axx * ayy, yz = ayy * azz;
    const R cxx = yz - ayz * ayz, cxy = axz * ayz - axy * azz;
    const R cxz = axy * ayz - axz * ayy;
    const R determinant = axx * cxx + axy * cxy + axz * cxz, all = xy * azz;
    const R inverseAll = one / (determinant * all), scale = all * inverseAll;
    const R share = determinant * inverseAll;
    p.massX = yz * share;
    p.massY = axx * azz * share;
    p.massZ = xy * share;
    p.lessX = axz * p.massX;
    p.lessY = ayz * p.massY;
    p.xx = cxx * scale;
    p.xy = cxy * scale;
    p.xz = cxz * scale;
    p.yy = (axx * azz - axz * axz) * scale;
    p.yz = (axy * axz - axx * ayz) * scale;
    p.zz = (xy - axy * axy) * scale;
  }

  static void apply(const BodyModel& body, const LaneMask<R>& lanes, const ContactPoint<R>& p,
                    const Vec<R>& impulse, Vec<R>& velocity, Vec<R>& spin) {
    setWhere(lanes, velocity, velocity + impulse * R(body.inverseMass));
    if (body.isotropic) {
      const Vec<R> turned = {spin.x + p.turnZ.x * impulse.z + p.turnY.x * impulse.y,
                             spin.y + p.turnZ.y * impulse.z + p.turnX.y * impulse.x,
                             spin.z + (p.turnX.z * impulse.x + p.turnY.z * impulse.y)};
      setWhere(lanes, spin, turned);
    } else {
      const Vec<R> pressed = spin + p.turnZ * impulse.z;
      setWhere(lanes, spin, pressed + (p.turnX * impulse.x + p.turnY * impulse.y));
    }
  }

  /// One Gauss-Seidel visit in the lanes `moves`; returns the size of the change, 0 in others.
  static R relax(const BodyModel& body, const LaneMask<R>& moves, ContactPoint<R>& p,
                 Vec<R>& velocity, Vec<R>& spin) {
    const R ux = (velocity.x - p.target.x) + (spin.y * p.r.z - spin.z * p.r.y);
    const R uy = (velocity.y - p.target.y) + (spin.z * p.r.x - spin.x * p.r.z);
    const R uz = (velocity.z - p.target.z) + (spin.x * p.r.y - spin.y * p.r.x);
    const Vec<R> stick = {p.impulse.x - (p.xx * ux + p.xy * uy + p.xz * uz),
                          p.impulse.y - (p.xy * ux + p.yy * uy + p.yz * uz),
                          p.impulse.z - (p.xz * ux + p.yz * uy + p.zz * uz)};
    const R limit = R(body.surface.friction) * stick.z;
    const LaneMask<R> slides =
        (stick.z < R(0.0)) | (stick.x * stick.x + stick.y * stick.y > limit * limit);
    Vec<R> next = stick;
    if (anyLane(slides)) setWhere(slides, next, slide(body, p, {ux, uy, uz}));
    const Vec<R> change = next - p.impulse;
    apply(body, moves, p, change, velocity, spin);
    setWhere(moves, p.impulse, next);
    return select(moves, laneAbs(change.x) + laneAbs(change.y) + laneAbs(change.z), R(0.0));
  }

  /// Impulse of a point that slides or parts: the normal one first, then friction within its limit.
  static Vec<R> slide(const BodyModel& body, const ContactPoint<R>& p, const Vec<R>& u) {
    const R zero(0.0), push = laneMax(zero - p.impulse.z, (zero - u.z) * p.massZ);
    const R pressed = p.impulse.z + push;
    const R dragX = (p.impulse.x - u.x * p.massX) - push * p.lessX;
    const R dragY = (p.impulse.y - u.y * p.massY) - push * p.lessY;
    const R limit = R(body.surface.friction) * pressed;
    const R size2 = dragX * dragX + dragY * dragY;
    // Nothing is slowed from 0, so that what is divided by it is not taken.
    const R scale = select(size2 > limit * limit, limit / laneSqrt(size2), R(1.0));
    return {dragX * scale, dragY * scale, pressed};
  }

  /// Rolling and spinning friction: moments that stop the spin, at most the friction arm times the
  /// normal impulse.
  void brake(const BodyModel& body, const WorldInertia<R>& inverse, const LaneMask<R>& live,
             Vec<R>& spin) {
    R press(0.0);
    for (int k = 0; k < count; ++k) press = press + points[k].impulse.z;
    const Vec<R> u = spin - spinTarget;
    Vec<R> next = {moment.x - u.x / inverse.xx, moment.y - u.y / inverse.yy,
                   moment.z - u.z / inverse.zz};
    const R roll = press * rollingArm;
    const R size = laneSqrt(next.x * next.x + next.y * next.y);
    const R scale = select(size > roll, roll / laneMax(size, R(1e-300)), R(1.0));
    const R turn = press * R(body.surface.spinningFriction);
    next = {next.x * scale, next.y * scale, laneMax(R(0.0) - turn, laneMin(turn, next.z))};
    setWhere(live, spin, spin + inverse * (next - moment));
    setWhere(live, moment, next);
  }
};

}  // namespace ifa

#endif
