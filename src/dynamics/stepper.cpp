// SPDX-License-Identifier: Apache-2.0
#include "dynamics/stepper.h"

#include <algorithm>
#include <cmath>

#include "dynamics/energy.h"
#include "dynamics/height_cubic.h"
#include "dynamics/impact_law.h"
#include "dynamics/midpoint_step.h"
#include "dynamics/support.h"

namespace ifa {

namespace {

/// Impacts at one instant before the body is taken to stay on the ground for the next step.
constexpr int kImpactsAtOnce = 6;
/// Slower approaches of a vertex at the ground are left to the next step, m/s.
constexpr double kLandingSpeed = 5e-3;
/// A vertex at the ground that rises faster is not held, m/s.
constexpr double kPartingSpeed = 0.1;
/// One that rises no faster touches, m/s.
constexpr double kTouchingSpeed = 5e-3;
/// A body that hardly moves but is not supported is held by rolling friction for so long, s ...
constexpr double kHeld = 0.03;
/// ... and at rest, balanced on an edge to the last bit, after so long, s.
constexpr double kBalanced = 2;
constexpr int kMostCuts = 4;
constexpr double kShortestStep = 1e-6;  // s
/// Longer steps are told in two halves, so that what listens and draws needs no more than this, s.
constexpr double kLongestPiece = 1e-3 * (1 + 1e-9);
/// By how much the middle of such a step may be moved to keep its energy, in gaps that touch.
constexpr double kMostRise = 0.1;

}  // namespace

Stepper::Stepper(const BodyModel& body)
    : body_(body),
      restitution_(body.surface.restitution),
      rotation_(Quat<double>{1, 0, 0, 0}),
      watch_(body) {
  chosen_.reserve(body.x.size());
}

void Stepper::start(const KernelState<double>& state) { start(state, body_.surface.restitution); }

void Stepper::start(const KernelState<double>& state, double restitution) {
  restitution_ = restitution;
  state_ = before_ = state;
  phase_ = Phase::kContact;  // contact() lifts off at once when nothing is near
  seen_ = false;
  solver_.count = lastCount_ = impactsHere_ = stuck_ = 0;
  lastStep_ = 0;
  quietSince_ = -1;
}

Advance Stepper::advance(double limit) {
  switch (phase_) {
    case Phase::kFlight:
      return fly(limit);
    case Phase::kContact:
      return touch(limit);
    case Phase::kHalfway:
      before_ = state_;
      state_ = end_;
      return finish();
    case Phase::kRest:
      break;
  }
  return Advance::kRest;
}

Advance Stepper::fly(double limit) {
  const FlightSegment segment(body_, state_, limit - state_.time);
  const double hit = segment.firstTouch();
  lastCount_ = 0;
  lastStep_ = 0;
  quietSince_ = -1;
  seen_ = false;
  if (hit > segment.length()) {
    state_ = segment.at(segment.length());
    impactsHere_ = stuck_ = 0;
    return Advance::kFlight;
  }
  state_ = segment.at(hit);
  phase_ = Phase::kContact;
  if (hit > 1e-6) impactsHere_ = stuck_ = 0;
  return Advance::kTouch;
}

/// Measures the vertices that a step from here can bring to the ground.
void Stepper::look() {
  if (!seen_) {
    rotation_ = Rotation<double>(state_.q);
    kinetic_ = kineticEnergy(body_, state_.velocity, state_.w);
  }
  const Vec<double>& up = rotation_.rows[2];
  const bool remade = watch_.cover(state_.position.z, up, kinetic_);
  if (seen_ && !remade) return;
  watch_.measure(state_.position.z, state_.velocity.z, up, cross(up, state_.w), now_);
  seen_ = true;
}

Advance Stepper::touch(double limit) {
  look();
  if (impactsHere_ < kImpactsAtOnce) {
    for (std::size_t i = 0; i < watch_.count(); ++i) {
      if (now_.gap[i] <= body_.hitGap && now_.rate[i] < -kLandingSpeed) return impact();
    }
  }
  return contact(limit);
}

void Stepper::gatherHits() {
  chosen_.clear();
  for (std::size_t i = 0; i < watch_.count(); ++i) {
    if (now_.gap[i] <= laneMax(body_.slop, -now_.rate[i] * kTogether)) chosen_.push_back(i);
  }
}

/// Vertices at the ground, and those that sink to it within the step without a bounce to come.
void Stepper::gatherHeld(double step) {
  chosen_.clear();
  const double fall = 0.5 * kGravity * step;
  const double far = body_.hitGap + (kLandingSpeed + fall) * step;
  for (std::size_t i = 0; i < watch_.count(); ++i) {
    const double gap = now_.gap[i];
    if (gap > far) continue;
    const double rate = now_.rate[i];
    const bool held = gap <= body_.hitGap ? rate < kPartingSpeed
                                          : gap + (rate - fall) * step < 0 &&
                                                rate * step >= -2 * gap && rate >= -kLandingSpeed;
    if (held) chosen_.push_back(i);
  }
}

/// Makes contact points of the chosen vertices, of at most eight of them.
void Stepper::addPoints() {
  if (chosen_.size() > Solver::kMaxPoints) {
    thinBySpread(watch_, now_, rotation_, Solver::kMaxPoints, chosen_);
  }
  solver_.count = 0;
  for (const std::size_t i : chosen_) {
    ContactPoint<double>& p = solver_.points[solver_.count++];
    p.place = watch_.place(i);
    p.gap = now_.gap[i];
    p.rate = now_.rate[i];
    p.r = rotation_ * p.place;
    p.impulse = {};
  }
}

Advance Stepper::impact() {
  gatherHits();
  addPoints();
  before_ = state_;
  const ImpactLaw<double> law(body_, rotation_, state_.velocity, state_.w);
  const Impact<double> after = law.solve(restitution_, solver_);
  state_.velocity = after.velocity;
  state_.w = after.w;
  impulse_ = after.impulse;
  const Vec<double>& up = rotation_.rows[2];
  watch_.measure(state_.position.z, state_.velocity.z, up, cross(up, state_.w), now_);
  kinetic_ = kineticEnergy(body_, state_.velocity, state_.w);
  ++impactsHere_;
  lastCount_ = 0;
  quietSince_ = -1;
  return Advance::kImpact;
}

Advance Stepper::lift() {
  phase_ = ++stuck_ > 200 ? Phase::kRest : Phase::kFlight;
  return Advance::kLift;
}

void Stepper::warmStart(double step) {
  solver_.moment = {};
  // Rolling friction stops a body that rolls; it does not hold one that is about to fall.
  const bool falling = quietSince_ >= 0 && state_.time - quietSince_ > kHeld;
  solver_.rollingArm = falling ? 0 : body_.surface.rollingFriction;
  if (lastCount_ == 0 || lastStep_ <= 0) return;
  const double scale = step / lastStep_;
  solver_.moment = lastMoment_ * scale;
  for (int k = 0; k < solver_.count; ++k) {
    for (int j = 0; j < lastCount_; ++j) {
      const auto& old = last_[static_cast<std::size_t>(j)];
      if (old.vertex == vertexOf(k)) solver_.points[k].impulse = old.impulse * scale;
    }
  }
}

/// Seconds until a vertex that was not held is at the ground, where it ends under it; else `step`.
double Stepper::overshoot(double step) const {
  double first = 1;
  for (std::size_t i = 0; i < watch_.count(); ++i) {
    if (next_.gap[i] >= -0.5 * body_.hitGap || now_.gap[i] <= body_.hitGap) continue;
    if (std::find(chosen_.begin(), chosen_.end(), i) != chosen_.end()) continue;
    const HeightCubic<double> height(now_.gap[i], now_.rate[i], next_.gap[i], next_.rate[i], step);
    first = laneMin(first, height.firstTouch());
  }
  return first * step;
}

/// Solves a step and takes it; false when nothing pushes.
bool Stepper::solveStep(double step) {
  warmStart(step);
  const Midpoint<double> middle = solveMidpoint(body_, state_, rotation_, step, solver_);
  impulse_ = middle.impulse;
  if (impulse_.z <= 0 && stuck_ < 100) return false;
  moveByMidpoint(body_, middle, step, state_, rotation_);
  return true;
}

/// Makes the state in the middle of a long step. False where it would be moved too much.
bool Stepper::halve(double step, double energy0) {
  if (step <= kLongestPiece) return true;
  const double energy1 = kinetic_ + body_.mass * kGravity * state_.position.z;
  const double rise = halveStep(body_, before_, energy0, state_, energy1, step, middle_);
  return std::abs(rise) <= kMostRise * body_.slop;
}

/// What the next step starts from.
void Stepper::keep(double step) {
  std::swap(now_, next_);
  for (int k = 0; k < solver_.count; ++k) {
    last_[static_cast<std::size_t>(k)] = {vertexOf(k), solver_.points[k].impulse};
  }
  lastCount_ = solver_.count;
  lastMoment_ = solver_.moment;
  lastStep_ = step;
  impactsHere_ = stuck_ = 0;
}

Advance Stepper::contact(double limit) {
  before_ = state_;
  const double energy0 = kinetic_ + body_.mass * kGravity * state_.position.z;
  const double spin2 = dot(state_.w, state_.w), turn = body_.settings.stepAngle;
  double step = laneMin(body_.step, limit - state_.time);
  if (spin2 * step * step > turn * turn) step = turn / std::sqrt(spin2);
  for (int cuts = 0;; ++cuts) {
    gatherHeld(step);
    if (chosen_.empty()) return lift();
    addPoints();
    if (!solveStep(step)) return lift();
    kinetic_ = spendGain(body_, energy0, state_);
    const Vec<double>& up = rotation_.rows[2];
    watch_.measure(state_.position.z, state_.velocity.z, up, cross(up, state_.w), next_);
    double shorter = overshoot(step);
    if (shorter >= step && !halve(step, energy0)) shorter = 0.5 * step;
    if (shorter >= step || cuts == kMostCuts) break;
    state_ = before_;
    rotation_ = Rotation<double>(state_.q);
    kinetic_ = kineticEnergy(body_, state_.velocity, state_.w);
    step = laneMax(shorter, kShortestStep);
  }
  keep(step);
  if (step <= kLongestPiece) return finish();
  end_ = state_;
  state_ = middle_;
  impulse_ = impulse_ * 0.5;
  phase_ = Phase::kHalfway;
  return Advance::kContact;
}

Advance Stepper::finish() {
  phase_ = settled() ? Phase::kRest : Phase::kContact;
  return Advance::kContact;
}

bool Stepper::settled() {
  const double slow = 0.5 * body_.settings.restSpeed * body_.settings.restSpeed;
  if (kinetic_ >= slow * body_.mass) {
    quietSince_ = -1;
    return false;
  }
  if (quietSince_ < 0) quietSince_ = state_.time;
  return isSupported(watch_, now_, rotation_, body_) || state_.time - quietSince_ > kBalanced;
}

bool Stepper::touching() const {
  if (phase_ == Phase::kFlight) return false;
  for (std::size_t i = 0; i < watch_.count(); ++i) {
    if (now_.gap[i] <= body_.slop && now_.rate[i] <= kTouchingSpeed) return true;
  }
  return false;
}

ContactStep Stepper::contactStep() const {
  ContactStep step;
  step.time = before_.time;
  step.duration = state_.time - before_.time;
  step.impulse = {impulse_.x, impulse_.y, impulse_.z};
  step.before = rigidState(before_);
  step.after = rigidState(state_);
  step.touching = touching();
  return step;
}

}  // namespace ifa
