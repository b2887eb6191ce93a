// SPDX-License-Identifier: Apache-2.0
// One step in contact by the implicit midpoint rule, and what keeps it from gaining energy.
#ifndef IFA_DYNAMICS_MIDPOINT_STEP_H
#define IFA_DYNAMICS_MIDPOINT_STEP_H

#include "dynamics/contact_solver.h"
#include "dynamics/free_rotation.h"
#include "dynamics/lane_energy.h"

namespace ifa {

/// What the middle of a step gives.
template <class R>
struct Midpoint {
  Vec<R> velocity;  ///< world frame, m/s
  Vec<R> w;         ///< body frame, rad/s
  Vec<R> momentum;  ///< angular, world frame, at the step's end
  Vec<R> impulse;   ///< sum over all points and the step, N s
};

/// Turns the arms to the middle of the step and says what velocity the points shall have there: on
/// the way from the one they begin with to none at the end, or one that brings them down to the
/// ground by then.
template <class R>
void aimPoints(const BodyModel& body, const KernelState<R>& state, const Rotation<R>& rotation,
               const Rotation<R>& middle, R step, ContactSolver<R>& solver) {
  const R half(0.5), zero(0.0);
  const Vec<R> spin = rotation * state.w;
  for (int k = 0; k < solver.count; ++k) {
    ContactPoint<R>& p = solver.points[k];
    const Vec<R> v = state.velocity + cross(spin, p.r);
    const LaneMask<R> above = p.gap > R(body.hitGap), under = p.gap <= R(-body.hitGap);
    R sink = select(under, zero, laneMin(half * p.rate, zero));
    if (anyLane(above)) setWhere(above, sink, (zero - p.gap) / step);
    p.target = {half * v.x, half * v.y, sink};
    p.r = middle * p.place;
  }
  solver.spinTarget = spin * half;
}

/// Solves a step for the points gathered in `solver` (here, place, gap, rate, r, and the impulses
/// and moment to start from). `rotation` is that of `state`.
template <class R>
[[nodiscard]] Midpoint<R> solveMidpoint(const BodyModel& body, const KernelState<R>& state,
                                        const Rotation<R>& rotation, R step,
                                        ContactSolver<R>& solver) {
  constexpr double kPrecision = 3e-5;  // m/s, a change of speed to which impulses are solved
  const Quat<R> halfway = state.q + timesPure(state.q, state.w) * (R(0.25) * step);
  const Rotation<R> middle(renormalised(halfway));
  aimPoints(body, state, rotation, middle, step, solver);
  const WorldInertia<R> inverse(body, middle);
  const Vec<R> momentum = angularMomentum(body, rotation, state.w);
  Vec<R> velocity = state.velocity, spin = inverse * momentum;
  velocity.z = velocity.z - R(0.5 * kGravity) * step;
  solver.solve(body, inverse, body.settings.iterations, R(kPrecision * body.mass), velocity, spin);
  const R two(2.0);
  return {velocity, middle.transposed(spin), momentum + solver.totalTurn() * two,
          solver.total() * two};
}

/// Goes on for `step` with the velocities of its middle; those of its end lie as far beyond.
/// `rotation` becomes that of the end.
template <class R>
void moveByMidpoint(const BodyModel& body, const Midpoint<R>& middle, R step, KernelState<R>& state,
                    Rotation<R>& rotation) {
  state.time = state.time + step;
  state.position = state.position + middle.velocity * step;
  state.velocity = middle.velocity * R(2.0) - state.velocity;
  state.q = renormalised(state.q + timesPure(state.q, middle.w) * (R(0.5) * step));
  rotation = Rotation<R>(state.q);
  state.w = spinOfMomentum(body, rotation, middle.momentum);
}

/// A step may gain a little over `energy0`, of the third order in its turn or where sweeps have not
/// settled: nothing may come of that. What a body without speed cannot spend, it spends by height.
/// Returns the kinetic energy that is left, J.
template <class R>
R spendGain(const BodyModel& body, R energy0, KernelState<R>& state) {
  const R zero(0.0), weight(body.mass * kGravity);
  const R moving = kineticEnergy(body, state.velocity, state.w);
  const R gain = moving + weight * state.position.z - energy0;
  const LaneMask<R> gains = gain > zero;
  if (!anyLane(gains)) return moving;
  const R kinetic = laneMax(moving - gain, zero);
  const R scale = select(moving > gain, laneSqrt(kinetic / moving), zero);
  setWhere(gains, state.velocity, state.velocity * scale);
  setWhere(gains, state.w, state.w * scale);
  const LaneMask<R> stands = gain > moving;
  if (anyLane(stands)) {
    setWhere(stands, state.position.z, state.position.z - (gain - moving) / weight);
  }
  return select(gains, kinetic, moving);
}

/// Makes the state in the middle of a long step one through which energy falls, from `energy0` at
/// `before` to `energy1` at `after`: of two velocities the mean has less energy than they have on
/// average, and what is missing goes into height (in free fall that is the height of the parabola
/// over its chord). Returns that height, m.
template <class R>
R halveStep(const BodyModel& body, const KernelState<R>& before, R energy0,
            const KernelState<R>& after, R energy1, R step, KernelState<R>& middle) {
  const R half(0.5), weight(body.mass * kGravity);
  middle = {before.time + half * step, (before.position + after.position) * half,
            renormalised((before.q + after.q) * half), (before.velocity + after.velocity) * half,
            (before.w + after.w) * half};
  const R energy = totalEnergy(body, middle);
  const R rise = (laneMin(laneMax(energy, energy1), energy0) - energy) / weight;
  middle.position.z = middle.position.z + rise;
  return rise;
}

}  // namespace ifa

#endif
