// SPDX-License-Identifier: Apache-2.0
#include "dynamics/stepper.h"

#include <algorithm>
#include <cmath>

#include "dynamics/energy.h"

namespace ifa {

namespace {

/// Impacts at one instant before the body is taken to stay on the ground for the next step.
constexpr int kImpactsAtOnce = 6;
/// Vertices that would hit within this time hit together, s.
constexpr double kTogether = 1e-4;
/// A body that hardly moves for so long is at rest even when it stands on less than three points,
/// s.
constexpr double kQuiet = 0.5;

}  // namespace

Stepper::Stepper(const BodyModel& body)
    : body_(body),
      restitution_(body.surface.restitution),
      gap_(body.x.size()),
      rate_(body.x.size()) {
  candidates_.reserve(body.x.size());
}

void Stepper::start(const KernelState<double>& state) { start(state, body_.surface.restitution); }

void Stepper::start(const KernelState<double>& state, double restitution) {
  restitution_ = restitution;
  state_ = before_ = state;
  phase_ = Phase::kContact;  // contact() lifts off at once when nothing is near
  solver_.count = lastCount_ = impactsHere_ = stuck_ = 0;
  lastStep_ = lastPress_ = 0;
  quietSince_ = -1;
}

Advance Stepper::advance(double limit) {
  switch (phase_) {
    case Phase::kFlight:
      return fly(limit);
    case Phase::kContact:
      return touch(limit);
    case Phase::kRest:
      break;
  }
  return Advance::kRest;
}

Advance Stepper::fly(double limit) {
  const FlightSegment segment(body_, state_, limit - state_.time);
  const double hit = segment.firstTouch();
  lastCount_ = 0;
  lastStep_ = lastPress_ = 0;
  quietSince_ = -1;
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

void Stepper::measure(const Rotation<double>& rotation, const Vec<double>& velocity,
                      const Vec<double>& w) {
  const Vec<double> up = rotation.rows[2], turn = cross(up, w);
  const double height = state_.position.z, rise = velocity.z;
  const double *x = body_.x.data(), *y = body_.y.data(), *z = body_.z.data();
  for (std::size_t i = 0; i < gap_.size(); ++i) {
    gap_[i] = height + (x[i] * up.x + y[i] * up.y + z[i] * up.z);
    rate_[i] = rise + (x[i] * turn.x + y[i] * turn.y + z[i] * turn.z);
  }
}

Advance Stepper::touch(double limit) {
  const Rotation<double> rotation(state_.q);
  measure(rotation, state_.velocity, state_.w);
  if (impactsHere_ < kImpactsAtOnce) {
    for (std::size_t i = 0; i < gap_.size(); ++i) {
      if (gap_[i] <= body_.slop && rate_[i] < -body_.settings.bounceSpeed) return impact(rotation);
    }
  }
  return contact(rotation, limit);
}

void Stepper::addPoint(const Rotation<double>& rotation, std::size_t vertex) {
  ContactPoint<double>& p = solver_.points[solver_.count++];
  p.vertex = static_cast<int>(vertex);
  p.r = rotation * Vec<double>{body_.x[vertex], body_.y[vertex], body_.z[vertex]};
  p.impulse = {};
}

/// Keeps at most eight of the candidates: the lowest one, then always the one farthest from those
/// kept, so that a body on a round base does not rock for want of support.
void Stepper::thin(const Rotation<double>& rotation) {
  constexpr std::size_t kMost = ContactSolver<double>::kMaxPoints;
  std::vector<Vec<double>> place(candidates_.size());
  std::vector<double> far(candidates_.size(), 1e9);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const auto i = static_cast<std::size_t>(candidates_[c]);
    place[c] = rotation * Vec<double>{body_.x[i], body_.y[i], body_.z[i]};
  }
  std::size_t next = 0;
  for (std::size_t c = 1; c < candidates_.size(); ++c) {
    if (gap_[static_cast<std::size_t>(candidates_[c])] <
        gap_[static_cast<std::size_t>(candidates_[next])]) {
      next = c;
    }
  }
  std::vector<int> kept;
  while (kept.size() < kMost) {
    kept.push_back(candidates_[next]);
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const double dx = place[c].x - place[next].x, dy = place[c].y - place[next].y;
      far[c] = std::min(far[c], dx * dx + dy * dy);
    }
    next = static_cast<std::size_t>(std::max_element(far.begin(), far.end()) - far.begin());
  }
  candidates_ = kept;
}

/// Makes the contact points: vertices that touch (`atOnce`), or would within `reach` seconds.
void Stepper::gather(const Rotation<double>& rotation, double reach, bool atOnce) {
  candidates_.clear();
  const double fall = kGravity * reach;
  for (std::size_t i = 0; i < gap_.size(); ++i) {
    const bool near = gap_[i] <= (atOnce ? laneMax(body_.slop, -rate_[i] * kTogether) : body_.slop);
    const bool coming = gap_[i] + (rate_[i] - fall) * reach < 0;
    if (atOnce ? near : coming && (near || rate_[i] >= -body_.settings.bounceSpeed)) {
      candidates_.push_back(static_cast<int>(i));
    }
  }
  solver_.count = 0;
  if (candidates_.size() > ContactSolver<double>::kMaxPoints) thin(rotation);
  for (const int i : candidates_) addPoint(rotation, static_cast<std::size_t>(i));
}

/// Newton restitution at every vertex that hits; where friction would let that gain energy, as much
/// of it as gains none: impulses between those of a plastic impact, which never gains, and the full
/// ones.
Advance Stepper::impact(const Rotation<double>& rotation) {
  gather(rotation, 0, true);
  before_ = state_;
  const Vec<double> spin0 = rotation * state_.w;
  const auto solve = [&](double restitution, Vec<double>& velocity, Vec<double>& spin) {
    for (int k = 0; k < solver_.count; ++k) {
      ContactPoint<double>& p = solver_.points[k];
      const double rate = rate_[static_cast<std::size_t>(p.vertex)];
      p.bound = rate < -body_.settings.bounceSpeed ? -restitution * rate : 0;
      p.impulse = {};
    }
    velocity = state_.velocity;
    spin = spin0;
    solver_.solve(body_, rotation, body_.settings.impactIterations, velocity, spin);
    return solver_.total();
  };
  Vec<double> velocity, spin;
  impulse_ = solve(restitution_, velocity, spin);
  const double energy0 = kineticEnergy(body_, state_.velocity, state_.w);
  Vec<double> w = rotation.transposed(spin);
  if (kineticEnergy(body_, velocity, w) > energy0) {
    Vec<double> plasticVelocity, plasticSpin;
    const Vec<double> plastic = solve(0, plasticVelocity, plasticSpin);
    const Vec<double> plasticW = rotation.transposed(plasticSpin);
    const Vec<double> dv = velocity - plasticVelocity, dw = w - plasticW;
    const double a = kineticEnergy(body_, dv, dw),
                 c = kineticEnergy(body_, plasticVelocity, plasticW) - energy0;
    const double b = body_.mass * dot(plasticVelocity, dv) + body_.inertia.x * plasticW.x * dw.x +
                     body_.inertia.y * plasticW.y * dw.y + body_.inertia.z * plasticW.z * dw.z;
    // Energy along the way is a s^2 + b s + c, with c <= 0 and the whole above 0 at s = 1.
    const double s =
        laneMax(0, laneMin(1, (std::sqrt(laneMax(0, b * b - 4 * a * c)) - b) / (2 * a)));
    velocity = plasticVelocity + dv * s;
    w = plasticW + dw * s;
    impulse_ = plastic + (impulse_ - plastic) * s;
  }
  state_.velocity = velocity;
  lastPress_ = impulse_.z;
  Vec<double> turned = rotation * w;
  rollingFriction(1, rotation, turned);
  state_.w = rotation.transposed(turned);
  ++impactsHere_;
  lastCount_ = 0;
  lastPress_ = 0;
  quietSince_ = -1;
  return Advance::kImpact;
}

/// Longest step in which the body turns little and no free vertex hits at speed before the step's
/// end.
double Stepper::chooseStep(double limit) const {
  const KernelSettings& set = body_.settings;
  double step = laneMin(set.step, limit - state_.time);
  const double rate = std::sqrt(dot(state_.w, state_.w));
  if (rate * step > set.stepAngle) step = set.stepAngle / rate;
  for (std::size_t i = 0; i < gap_.size(); ++i) {
    if (gap_[i] <= body_.slop || rate_[i] >= -set.bounceSpeed) continue;
    const double reach = (gap_[i] - 0.25 * body_.slop) / (kGravity * step - rate_[i]);
    if (reach < step) step = laneMax(reach, 1e-6);
  }
  return step;
}

void Stepper::warmStart(double scale) {
  for (int k = 0; k < solver_.count; ++k) {
    for (int j = 0; j < lastCount_; ++j) {
      const auto& old = last_[static_cast<std::size_t>(j)];
      if (old.vertex == solver_.points[k].vertex) solver_.points[k].impulse = old.impulse * scale;
    }
  }
}

/// Seconds until a vertex that is no contact point would be under the ground, or a value over
/// `step`.
double Stepper::overshoot(const Rotation<double>& rotation, const Vec<double>& velocity,
                          const Vec<double>& spin, double step) const {
  const Vec<double> up = rotation.rows[2], turn = cross(up, rotation.transposed(spin));
  const double *x = body_.x.data(), *y = body_.y.data(), *z = body_.z.data();
  const double deepest = -0.5 * body_.slop;
  double least = 2 * step;
  for (std::size_t i = 0; i < gap_.size(); ++i) {
    const double rate = velocity.z + (x[i] * turn.x + y[i] * turn.y + z[i] * turn.z);
    if (gap_[i] + rate * step >= deepest) continue;
    bool held = false;
    for (int k = 0; k < solver_.count; ++k) {
      held = held || solver_.points[k].vertex == static_cast<int>(i);
    }
    if (!held) least = laneMin(least, laneMax(gap_[i], 0) / -rate);
  }
  return least;
}

/// Coulomb-like moments at the contact: they brake rolling about a horizontal axis and spinning
/// about the vertical one, by at most the friction arm times the normal impulse of the step before.
void Stepper::rollingFriction(double step, const Rotation<double>& rotation,
                              Vec<double>& spin) const {
  const double press = lastPress_ * step;
  if (press <= 0) return;
  const WorldInertia<double> inverse(body_, rotation);
  const auto brake = [&](const Vec<double>& axis, double rate, double arm) {
    const Vec<double> turn = inverse * axis;
    const double moment = laneMin(arm * press, rate / dot(axis, turn));
    spin = spin - turn * moment;
  };
  const double roll = std::sqrt(spin.x * spin.x + spin.y * spin.y);
  if (roll > 0 && body_.surface.rollingFriction > 0) {
    brake({spin.x / roll, spin.y / roll, 0}, roll, body_.surface.rollingFriction);
  }
  if (spin.z != 0 && body_.surface.spinningFriction > 0) {
    brake({0, 0, spin.z > 0 ? 1.0 : -1.0}, std::fabs(spin.z), body_.surface.spinningFriction);
  }
}

/// Takes the step: drift with the new velocities; the angular momentum stays through the turn.
void Stepper::move(const Rotation<double>& rotation, const Vec<double>& velocity,
                   const Vec<double>& spin, double step) {
  const Vec<double> w = rotation.transposed(spin);
  state_.time += step;
  state_.position = state_.position + velocity * step;
  state_.velocity = velocity;
  state_.q = normalised(state_.q + timesPure(state_.q, w) * (0.5 * step));
  state_.w = w;
  if (!body_.isotropic) {
    const Vec<double> momentum = angularMomentum(body_, rotation, w);
    state_.w = spinOfMomentum(body_, Rotation<double>(state_.q), momentum);
  }
}

Advance Stepper::contact(const Rotation<double>& rotation, double limit) {
  before_ = state_;
  double step = chooseStep(limit);
  Vec<double> velocity, spin;
  for (int attempt = 0;; ++attempt) {
    gather(rotation, step, false);
    if (solver_.count == 0) {
      phase_ = Phase::kFlight;
      if (++stuck_ > 200) phase_ = Phase::kRest;
      return Advance::kLift;
    }
    const double fall = kGravity * step;
    for (int k = 0; k < solver_.count; ++k) {
      ContactPoint<double>& p = solver_.points[k];
      p.bound = -laneMax(gap_[static_cast<std::size_t>(p.vertex)], 0) / step;
    }
    warmStart(lastStep_ > 0 ? step / lastStep_ : 0);
    velocity = state_.velocity;
    velocity.z -= fall;
    spin = rotation * state_.w;
    rollingFriction(step, rotation, spin);
    solver_.solve(body_, rotation, body_.settings.iterations, velocity, spin);
    const double earlier = overshoot(rotation, velocity, spin, step);
    if (earlier > step || attempt == 2) break;
    step = laneMax(earlier, 1e-6);
  }
  impulse_ = solver_.total();
  if (impulse_.z <= 0 && stuck_ < 100) {
    phase_ = Phase::kFlight;
    ++stuck_;
    return Advance::kLift;
  }
  const double energy0 = totalEnergy(body_, state_);
  move(rotation, velocity, spin, step);
  // The step itself may gain a little where the turn is finite; nothing may come of that.
  const double gain = totalEnergy(body_, state_) - energy0;
  const double moving = kineticEnergy(body_, state_.velocity, state_.w);
  if (gain > 0 && moving > 0) {
    const double scale = moving > gain ? std::sqrt((moving - gain) / moving) : 0;
    state_.velocity = state_.velocity * scale;
    state_.w = state_.w * scale;
  }
  for (int k = 0; k < solver_.count; ++k) last_[static_cast<std::size_t>(k)] = solver_.points[k];
  lastCount_ = solver_.count;
  lastStep_ = step;
  lastPress_ = impulse_.z / step;
  impactsHere_ = stuck_ = 0;
  const double slow = 0.5 * body_.settings.restSpeed * body_.settings.restSpeed;
  const double perMass = kineticEnergy(body_, state_.velocity, state_.w) / body_.mass;
  if (perMass < slow) {
    if (quietSince_ < 0) quietSince_ = state_.time;
    if (supported() || state_.time - quietSince_ > kQuiet) phase_ = Phase::kRest;
  } else {
    quietSince_ = -1;
  }
  return Advance::kContact;
}

/// The centre of mass is above the polygon of contact points: seen from it, points lie on both
/// sides of the line to every point.
bool Stepper::supported() const {
  if (solver_.count < 3) return false;
  for (int i = 0; i < solver_.count; ++i) {
    const Vec<double>& a = solver_.points[i].r;
    double left = 0, right = 0;
    for (int j = 0; j < solver_.count; ++j) {
      const Vec<double>& b = solver_.points[j].r;
      const double side = a.x * b.y - a.y * b.x;
      left = laneMax(left, side);
      right = laneMin(right, side);
    }
    const double margin = 1e-3 * body_.radius * body_.radius;
    if (left < margin || right > -margin) return false;
  }
  return true;
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
