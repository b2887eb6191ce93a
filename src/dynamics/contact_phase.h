// SPDX-License-Identifier: Apache-2.0
// What happens at the ground: an impact, or one try at a step in contact. Which vertices take part,
// whether a step must be cut and whether the body rests is decided for each lane by itself.
#ifndef IFA_DYNAMICS_CONTACT_PHASE_H
#define IFA_DYNAMICS_CONTACT_PHASE_H

#include "body/simple_hull.h"
#include "dynamics/chosen_vertices.h"
#include "dynamics/height_cubic.h"
#include "dynamics/impact_law.h"
#include "dynamics/midpoint_step.h"
#include "dynamics/simulation.h"
#include "dynamics/support.h"

namespace ifa {

/// The rules of contact (docs/dynamics.md).
struct ContactRules {
  /// Impacts at one instant before the body is taken to stay on the ground for the next step.
  static constexpr int kImpactsAtOnce = 6;
  /// Slower approaches of a vertex at the ground are left to the next step, m/s.
  static constexpr double kLandingSpeed = 5e-3;
  /// A vertex at the ground that rises faster is not held, m/s.
  static constexpr double kPartingSpeed = 0.1;
  /// One that rises no faster touches, m/s.
  static constexpr double kTouchingSpeed = 5e-3;
  /// A body that hardly moves but is not supported is held by rolling friction for so long, s ...
  static constexpr double kHeld = 0.03;
  /// ... and at rest, balanced on an edge to the last bit, after so long, s.
  static constexpr double kBalanced = 2;
  static constexpr int kMostCuts = 4;
  static constexpr double kShortestStep = 1e-6;  // s
  /// Longer steps are told in two halves, so that what listens and draws needs no more than this,
  /// s.
  static constexpr double kLongestPiece = 1e-3 * (1 + 1e-9);
  /// By how much the middle of such a step may be moved to keep its energy, in gaps that touch.
  static constexpr double kMostRise = 0.1;
  /// Lifts in a row after which a step is taken although nothing pushes, and after which it is
  /// given up.
  static constexpr int kLiftsToStay = 100, kLiftsToRest = 200;
};

/// Not thread safe. `Ground` has the gaps of the listed vertices now and at a step's end
/// (GroundWatch for one lane). The model must outlive it.
template <class R, class Ground>
class ContactPhase {
 public:
  using Sim = Simulation<R>;
  using Mask = LaneMask<R>;
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;

  explicit ContactPhase(const BodyModel& body) : body_(body) {}

  /// What each lane's vertices are about to do.
  struct Outlook {
    Mask hits;     ///< one at the ground comes down faster than a step may take
    Mask touches;  ///< one is at the ground and does not part from it
    R hitPoints;   ///< points of an impact
    R heldPoints;  ///< about as many of a step
  };
  [[nodiscard]] Outlook outlook(const Sim& sim, const Ground& ground) const;
  /// Parts of it, for one lane.
  [[nodiscard]] Mask hits(const Sim& sim, const Ground& ground) const;
  [[nodiscard]] Mask touches(const Ground& ground) const;
  /// An impact: changes velocities, and what `ground` has now of them.
  void impact(Sim& sim, const Rotation<R>& rotation, Ground& ground);
  /// One try at a step that does not pass `limit` (s). `sim` goes on where it is taken, and
  /// `rotation` becomes that of the end in all lanes.
  void tryStep(const R& limit, Sim& sim, Rotation<R>& rotation, Ground& ground);

  /// Sum of impulses over all points, N s; of half a step where it is told in halves.
  [[nodiscard]] const Vec<R>& impulse() const { return impulse_; }
  /// What a try came to: nothing holds or pushes the body; it must be tried again, shorter.
  /// Elsewhere the step was taken.
  [[nodiscard]] const Mask& lifts() const { return lifts_; }
  [[nodiscard]] const Mask& triesAgain() const { return again_; }
  /// Steps taken that are told in halves, and the state between these.
  [[nodiscard]] const Mask& halves() const { return halves_; }
  [[nodiscard]] const KernelState<R>& middle() const { return middle_; }
  /// Points that it had, of the lane that has most.
  [[nodiscard]] int points() const { return solver_.count; }
  /// Steps taken after which the body rests.
  [[nodiscard]] const Mask& rests() const { return rests_; }

 private:
  using Rules = ContactRules;
  using Solver = ContactSolver<R>;

  /// What a try leads to.
  struct End {
    KernelState<R> state;
    R kinetic;
  };

  void gatherHits(const Ground& ground);
  void gatherHeld(const R& step, const Ground& ground);
  void addPoints(const Rotation<R>& rotation, const Ground& ground);
  void thin(const Rotation<R>& rotation, const Ground& ground);
  void warmStart(const Sim& sim, const R& step);
  [[nodiscard]] R firstStep(const R& limit, const Sim& sim) const;
  [[nodiscard]] R overshoot(const R& step, const Ground& ground) const;
  [[nodiscard]] R halve(const Sim& sim, const R& energy0, const End& end, const R& step,
                        const R& shorter);
  void keep(const Mask& taken, const R& step, const End& end, Sim& sim) const;
  void settle(const Mask& taken, const Rotation<R>& rotation, const Ground& ground, Sim& sim);
  [[nodiscard]] Mask supported(const Mask& quiet, const Rotation<R>& rotation,
                               const Ground& ground);

  const BodyModel& body_;
  ChosenVertices<R, kMostHullVertices> chosen_;  ///< numbers in the ground's list
  std::uint8_t held_[kMostHullVertices]{};       ///< lanes in which a step holds them
  Solver solver_;
  R vertices_[Solver::kMaxPoints]{};  ///< hull vertices of its points
  Vec<R> impulse_{};
  KernelState<R> middle_{};
  Mask lifts_{}, again_{}, halves_{}, rests_{};
  std::vector<Spot> spots_[kLanes];
};

template <class R, class Ground>
LaneMask<R> ContactPhase<R, Ground>::hits(const Sim& sim, const Ground& ground) const {
  const R fast(-Rules::kLandingSpeed), near(body_.hitGap);
  Mask any(false);
  for (int i = 0; i < ground.count(); ++i) {
    const R gap = ground.gap(i), rate = ground.rate(i);
    any = any | ((gap <= near) & (rate < fast));
  }
  return any & (sim.impactsHere < R(Rules::kImpactsAtOnce));
}

template <class R, class Ground>
LaneMask<R> ContactPhase<R, Ground>::touches(const Ground& ground) const {
  const R slow(Rules::kTouchingSpeed), near(body_.slop);
  Mask any(false);
  for (int i = 0; i < ground.count(); ++i) {
    const R gap = ground.gap(i), rate = ground.rate(i);
    any = any | ((gap <= near) & (rate <= slow));
  }
  return any;
}

template <class R, class Ground>
auto ContactPhase<R, Ground>::outlook(const Sim& sim, const Ground& ground) const -> Outlook {
  const R zero(0.0), one(1.0), slop(body_.slop), together(kTogether), near(body_.hitGap);
  const R fast(-Rules::kLandingSpeed), slow(Rules::kTouchingSpeed), parting(Rules::kPartingSpeed);
  const bool skips = !ground.shared();  // what is too high; of few vertices it costs more
  R far{};
  if (skips) far = laneMax(laneMax(slop, near), ground.mostRate() * together);
  Outlook all{Mask(false), Mask(false), zero, zero};
  for (int i = 0; i < ground.count(); ++i) {
    const R gap = ground.gap(i);
    if (skips && !anyLane(gap <= far)) continue;
    const R rate = ground.rate(i);
    const Mask at = gap <= near;
    all.hits = all.hits | (at & (rate < fast));
    all.touches = all.touches | ((gap <= slop) & (rate <= slow));
    const Mask hit = gap <= laneMax(slop, (zero - rate) * together), held = at & (rate < parting);
    setWhere(hit, all.hitPoints, all.hitPoints + one);
    setWhere(held, all.heldPoints, all.heldPoints + one);
  }
  all.hits = all.hits & (sim.impactsHere < R(Rules::kImpactsAtOnce));
  return all;
}

template <class R, class Ground>
void ContactPhase<R, Ground>::gatherHits(const Ground& ground) {
  VertexSets sets(chosen_);
  const R zero(0.0), slop(body_.slop), together(kTogether);
  for (int i = 0; i < ground.count(); ++i) {
    sets.add(ground.gap(i) <= laneMax(slop, (zero - ground.rate(i)) * together), i);
  }
  sets.finish();
}

/// Vertices at the ground, and those that sink to it within the step without a bounce to come.
template <class R, class Ground>
void ContactPhase<R, Ground>::gatherHeld(const R& step, const Ground& ground) {
  VertexSets sets(chosen_);
  const R zero(0.0), near(body_.hitGap), parting(Rules::kPartingSpeed);
  const R landing(-Rules::kLandingSpeed), back(-2.0);
  const R fall = R(0.5 * kGravity) * step;
  const R far = near + (R(Rules::kLandingSpeed) + fall) * step;
  for (int i = 0; i < ground.count(); ++i) {
    const R gap = ground.gap(i);
    const Mask close = gap <= far;
    held_[i] = 0;
    if (!anyLane(close)) continue;
    const R rate = ground.rate(i);
    const Mask at = gap <= near;
    const Mask stays = at & (rate < parting);
    const Mask sinks =
        (gap + (rate - fall) * step < zero) & (rate * step >= back * gap) & (rate >= landing) & !at;
    const Mask holds = close & (stays | sinks);
    held_[i] = static_cast<std::uint8_t>(laneBits(holds));
    sets.add(holds, i);
  }
  sets.finish();
}

/// Of more than a contact can have, those that are spread best.
template <class R, class Ground>
void ContactPhase<R, Ground>::thin(const Rotation<R>& rotation, const Ground& ground) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (chosen_.count(lane) <= Solver::kMaxPoints) continue;
    const auto size = static_cast<std::size_t>(chosen_.count(lane));
    std::vector<LowSpot> spots(size);
    for (std::size_t k = 0; k < size; ++k) {
      const std::int64_t i = chosen_.number(k, lane);
      const Vec<R> p = ground.place(static_cast<int>(i));
      spots[k] = {{laneOf(dot(rotation.rows[0], p), lane), laneOf(dot(rotation.rows[1], p), lane)},
                  laneOf(ground.gap(static_cast<int>(i)), lane),
                  i};
    }
    thinBySpread(Solver::kMaxPoints, spots);
    for (std::size_t k = 0; k < spots.size(); ++k) chosen_.number(k, lane) = spots[k].number;
    chosen_.shorten(lane, Solver::kMaxPoints);
    for (int i = 0; i < ground.count(); ++i) held_[i] &= static_cast<std::uint8_t>(~(1U << lane));
    for (std::size_t k = 0; k < spots.size(); ++k) {
      held_[spots[k].number] |= static_cast<std::uint8_t>(1U << lane);
    }
  }
}

/// Makes contact points of the chosen vertices, of at most eight of them.
template <class R, class Ground>
void ContactPhase<R, Ground>::addPoints(const Rotation<R>& rotation, const Ground& ground) {
  if (chosen_.count() > Solver::kMaxPoints) thin(rotation, ground);
  solver_.count = chosen_.count();
  for (int k = 0; k < solver_.count; ++k) {
    ContactPoint<R>& p = solver_.points[k];
    const auto i = chosen_.at(k);
    p.here = chosen_.lanesWith(k);
    vertices_[k] = ground.vertexAt(i);
    p.place = ground.placeAt(i);
    p.gap = ground.gapAt(i);
    p.rate = ground.rateAt(i);
    p.r = rotation * p.place;
    p.impulse = {};
  }
}

template <class R, class Ground>
void ContactPhase<R, Ground>::impact(Sim& sim, const Rotation<R>& rotation, Ground& ground) {
  gatherHits(ground);
  addPoints(rotation, ground);
  const ImpactLaw<R> law(body_, rotation, sim.state.velocity, sim.state.w);
  const Impact<R> after = law.solve(sim.restitution, solver_);
  sim.state.velocity = after.velocity;
  sim.state.w = after.w;
  impulse_ = after.impulse;
  ground.measure(sim.state, rotation);
  sim.kinetic = kineticEnergy(body_, sim.state.velocity, sim.state.w);
  sim.impactsHere = sim.impactsHere + R(1.0);
  sim.lastCount = R(0.0);
  sim.quietSince = R(-1.0);
}

template <class R, class Ground>
void ContactPhase<R, Ground>::warmStart(const Sim& sim, const R& step) {
  const R zero(0.0);
  // Rolling friction stops a body that rolls; it does not hold one that is about to fall.
  const Mask falling =
      (sim.quietSince >= zero) & (sim.state.time - sim.quietSince > R(Rules::kHeld));
  solver_.rollingArm = select(falling, zero, R(body_.surface.rollingFriction));
  solver_.moment = {};
  const Mask known = (sim.lastCount > zero) & (sim.lastStep > zero);
  if (!anyLane(known)) return;
  const R scale = step / sim.lastStep;
  setWhere(known, solver_.moment, sim.lastMoment * scale);
  for (int j = 0; j < Solver::kMaxPoints; ++j) {
    const Mask had = known & (R(j) < sim.lastCount);
    if (!anyLane(had)) break;
    const Vec<R> impulse = sim.last[j].impulse * scale;
    for (int k = 0; k < solver_.count; ++k) {
      ContactPoint<R>& p = solver_.points[k];
      const Mask same = had & p.here & (sim.last[j].vertex == vertices_[k]);
      setWhere(same, p.impulse, impulse);
    }
  }
}

/// Share of the step after which a vertex that was not held is at the ground, where it ends under
/// it; else 1. As seconds. The first such vertex of each lane is solved for with those of the
/// others.
template <class R, class Ground>
R ContactPhase<R, Ground>::overshoot(const R& step, const Ground& ground) const {
  const R under(-0.5 * body_.hitGap), near(body_.hitGap);
  R first(1.0), gap0{}, rate0{}, gap1{}, rate1{};
  Mask found(false);
  for (int i = 0; i < ground.count(); ++i) {
    const R gap = ground.gap(i), nextGap = ground.nextGap(i);
    const Mask falls = (nextGap < under) & (gap > near) & !lanesOf<R>(held_[i]);
    if (!anyLane(falls)) continue;
    const R rate = ground.rate(i), nextRate = ground.nextRate(i);
    const Mask more = falls & found;
    if (anyLane(more)) {
      const HeightCubic<R> height(gap, rate, nextGap, nextRate, step);
      setWhere(more, first, laneMin(first, height.firstTouch(more)));
    }
    const Mask one = falls & !found;
    setWhere(one, gap0, gap);
    setWhere(one, rate0, rate);
    setWhere(one, gap1, nextGap);
    setWhere(one, rate1, nextRate);
    found = found | falls;
  }
  if (!anyLane(found)) return step;
  const HeightCubic<R> height(gap0, rate0, gap1, rate1, step);
  setWhere(found, first, laneMin(first, height.firstTouch(found)));
  return first * step;
}

/// Makes the state in the middle of a long step; where it would be moved too much, half the step is
/// to be tried instead. Returns the step to try, `shorter` where it is good.
template <class R, class Ground>
R ContactPhase<R, Ground>::halve(const Sim& sim, const R& energy0, const End& end, const R& step,
                                 const R& shorter) {
  halves_ = step > R(Rules::kLongestPiece);
  if (!anyLane(halves_)) return shorter;
  const R energy1 = end.kinetic + R(body_.mass * kGravity) * end.state.position.z;
  const R rise = halveStep(body_, sim.state, energy0, end.state, energy1, step, middle_);
  const Mask moved = !(laneAbs(rise) <= R(Rules::kMostRise * body_.slop));
  return select(halves_ & (shorter >= step) & moved, R(0.5) * step, shorter);
}

/// What the next step starts from.
template <class R, class Ground>
void ContactPhase<R, Ground>::keep(const Mask& taken, const R& step, const End& end,
                                   Sim& sim) const {
  const R zero(0.0);
  setWhere(taken, sim.state, end.state);
  setWhere(taken, sim.kinetic, end.kinetic);
  setWhere(taken, sim.lastStep, step);
  setWhere(taken, sim.lastMoment, solver_.moment);
  setWhere(taken, sim.impactsHere, zero);
  setWhere(taken, sim.stuck, zero);
  R count(0.0);
  for (int k = 0; k < solver_.count; ++k) {
    const ContactPoint<R>& p = solver_.points[k];
    setWhere(taken, sim.last[k].vertex, vertices_[k]);
    setWhere(taken, sim.last[k].impulse, p.impulse);
    setWhere(p.here, count, R(k + 1));
  }
  setWhere(taken, sim.lastCount, count);
}

/// Longest step, from here, that the body's turn and the limit allow.
template <class R, class Ground>
R ContactPhase<R, Ground>::firstStep(const R& limit, const Sim& sim) const {
  const R spin2 = dot(sim.state.w, sim.state.w);
  const double turn = body_.settings.stepAngle;
  R step = laneMin(R(body_.step), limit - sim.state.time);
  const Mask fast = spin2 * step * step > R(turn * turn);
  if (anyLane(fast)) setWhere(fast, step, R(turn) / laneSqrt(spin2));
  return select(sim.step > R(0.0), sim.step, step);
}

template <class R, class Ground>
void ContactPhase<R, Ground>::tryStep(const R& limit, Sim& sim, Rotation<R>& rotation,
                                      Ground& ground) {
  const R zero(0.0), one(1.0);
  const R energy0 = sim.kinetic + R(body_.mass * kGravity) * sim.state.position.z;
  const R step = firstStep(limit, sim), cuts = sim.cuts;
  sim.step = sim.cuts = zero;
  gatherHeld(step, ground);
  lifts_ = !chosen_.lanesWith(0);
  again_ = halves_ = rests_ = Mask(false);
  setWhere(lifts_, sim.stuck, sim.stuck + one);
  if (!anyLane(!lifts_)) return;
  addPoints(rotation, ground);
  warmStart(sim, step);
  const Midpoint<R> middle = solveMidpoint(body_, sim.state, rotation, step, solver_);
  impulse_ = middle.impulse;
  const Mask slack = (impulse_.z <= zero) & (sim.stuck < R(Rules::kLiftsToStay)) & !lifts_;
  setWhere(slack, sim.stuck, sim.stuck + one);
  lifts_ = lifts_ | slack;
  if (!anyLane(!lifts_)) return;
  End end{sim.state, zero};
  moveByMidpoint(body_, middle, step, end.state, rotation);
  end.kinetic = spendGain(body_, energy0, end.state);
  ground.measureNext(end.state, rotation);
  const R shorter = halve(sim, energy0, end, step, overshoot(step, ground));
  again_ = (shorter < step) & (cuts < R(Rules::kMostCuts)) & !lifts_;
  const Mask taken = !(lifts_ | again_);
  setWhere(again_, sim.step, laneMax(shorter, R(Rules::kShortestStep)));
  setWhere(again_, sim.cuts, cuts + one);
  if (!anyLane(taken)) return;
  keep(taken, step, end, sim);
  halves_ = halves_ & taken;
  if (anyLane(halves_)) setWhere(halves_, impulse_, impulse_ * R(0.5));
  settle(taken, rotation, ground, sim);
}

/// Whether the body rests where a step ended.
template <class R, class Ground>
void ContactPhase<R, Ground>::settle(const Mask& taken, const Rotation<R>& rotation,
                                     const Ground& ground, Sim& sim) {
  const R zero(0.0);
  const double slow = 0.5 * body_.settings.restSpeed * body_.settings.restSpeed;
  const Mask moves = sim.kinetic >= R(slow * body_.mass);
  setWhere(taken & moves, sim.quietSince, R(-1.0));
  const Mask quiet = taken & !moves;
  if (!anyLane(quiet)) return;
  setWhere(quiet & (sim.quietSince < zero), sim.quietSince, sim.state.time);
  const Mask balanced = sim.state.time - sim.quietSince > R(Rules::kBalanced);
  rests_ = quiet & (supported(quiet, rotation, ground) | balanced);
}

template <class R, class Ground>
LaneMask<R> ContactPhase<R, Ground>::supported(const Mask& quiet, const Rotation<R>& rotation,
                                               const Ground& ground) {
  const R near(body_.slop), zero(0.0), one(1.0);
  R count(0.0);
  for (int i = 0; i < ground.count(); ++i) {
    count = count + select(ground.nextGap(i) <= near, one, zero);
  }
  // Nothing stands on two.
  const Mask many = quiet & (count > R(2.0));
  if (!anyLane(many)) return many;
  for (auto& spots : spots_) spots.clear();
  for (int i = 0; i < ground.count(); ++i) {
    const Mask low = many & (ground.nextGap(i) <= near);
    if (!anyLane(low)) continue;
    const Vec<R> p = ground.place(i);
    const R x = dot(rotation.rows[0], p), y = dot(rotation.rows[1], p);
    for (unsigned bits = laneBits(low); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      spots_[lane].push_back({laneOf(x, lane), laneOf(y, lane)});
    }
  }
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (isSupported(spots_[lane], body_)) bits |= 1U << lane;
  }
  return lanesOf<R>(bits);
}

}  // namespace ifa

#endif
