// SPDX-License-Identifier: Apache-2.0
#include "audit/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/flight.h"

namespace ifa::audit_detail {
namespace {

// Within these a step of no duration is the listed change and not an impact, m/s and rad/s.
constexpr double kSameVelocity = 1e-9, kSameSpin = 1e-6;

bool within(const MotionSample& a, const MotionSample& b, double from, double to) {
  return a.time >= from - kSameTime && b.time <= to + kSameTime;
}

/// The contact whose event the step belongs to, else the next one (perhaps past the last).
std::size_t contactOf(const Motion& motion, const MotionSample& a, const MotionSample& b) {
  std::size_t index = 0;
  const auto over = [&](const MotionContact& c) {
    return c.end < a.time + kSameTime && !within(a, b, c.time, c.end);
  };
  while (index < motion.contacts.size() && over(motion.contacts[index])) ++index;
  return index;
}

bool isSilent(const Motion& motion, const MotionSample& a, const MotionSample& b) {
  return std::any_of(motion.silent.begin(), motion.silent.end(),
                     [&](const auto& interval) { return within(a, b, interval[0], interval[1]); });
}

StepKind kindOf(const Evidence& all, std::size_t contact, const MotionSample& a,
                const MotionSample& b) {
  const auto& contacts = all.motion.contacts;
  if (contact < contacts.size() && within(a, b, contacts[contact].time, contacts[contact].end)) {
    return StepKind::kEvent;
  }
  if (a.time >= all.restTime - kSameTime) return StepKind::kRest;
  if (isSilent(all.motion, a, b)) return StepKind::kSilent;
  return contact == contacts.size() && !contacts.empty() ? StepKind::kAfter : StepKind::kFlight;
}

Step makeStep(const Evidence& all, std::size_t from) {
  const MotionSample &a = all.sample(from), &b = all.sample(from + 1);
  Step step;
  step.from = from;
  step.contact = contactOf(all.motion, a, b);
  step.kind = kindOf(all, step.contact, a, b);
  step.duration = b.time - a.time;
  // Between contacts a retimed motion is played slower or faster than simulated.
  const bool retimed = step.kind == StepKind::kFlight || step.kind == StepKind::kSilent;
  step.simulated = retimed ? step.duration / all.retiming(step.contact) : step.duration;
  step.impulse = all.mass * (all.pace[from + 1] * b.velocity - all.pace[from] * a.velocity +
                             step.simulated * kGravity * Eigen::Vector3d::UnitZ());
  return step;
}

/// The sample after which contact `index` is left: where the listed change is seen, since the body
/// may be pressed down again in the same instant, or the last at the event's end.
std::size_t departureOf(const Evidence& all, std::size_t index) {
  const auto& samples = all.motion.trajectory;
  const double end = all.contact(index).end;
  std::size_t at = 0;
  while (at + 1 < samples.size() && samples[at].time < end - kSameTime) ++at;
  const bool followed = index + 1 < all.motion.contacts.size();
  for (; !isLastAt(all.motion, at); ++at) {
    const MotionSample &a = samples[at], &b = samples[at + 1];
    if (!followed) continue;
    const MotionContact& next = all.contact(index + 1);
    const Change change = all.changeBy(next.impulseChange, next.angularChange, b.orientation);
    const Eigen::Vector3d linear = next.retiming * b.velocity - a.velocity - change.linear;
    const Eigen::Vector3d angular =
        next.retiming * b.angularVelocity - a.angularVelocity - change.angular;
    if (linear.norm() < kSameVelocity && angular.norm() < kSameSpin) return at + 1;
  }
  return at;
}

/// By what the velocities of the samples are to be multiplied.
std::vector<double> paceOf(const Evidence& all) {
  const auto& samples = all.motion.trajectory;
  std::vector<double> pace(samples.size(), 1);
  std::size_t i = 0;
  for (std::size_t k = 0; k < all.motion.contacts.size(); ++k) {
    const double start = all.contact(k).time;
    // With its first sample the body arrives; the others at that time are the contact's own.
    for (; i < samples.size() && (samples[i].time < start - kSameTime); ++i) {
      pace[i] = all.retiming(k);
    }
    if (i < samples.size()) pace[i++] = all.retiming(k);
    i = std::max(i, all.departures[k]);
  }
  return pace;
}

/// After a terminal event's end and the silent contact that follows it.
double restTimeOf(const Motion& motion) {
  if (motion.contacts.empty() || !motion.contacts.back().terminal) {
    return std::numeric_limits<double>::infinity();
  }
  double time = motion.contacts.back().end;
  for (const auto& interval : motion.silent) time = std::max(time, interval[1]);
  return time;
}

double eventThreshold(const Motion& motion, const Body& body, const AuditSettings& settings) {
  if (motion.cut == EventCut::kPaper) return settings.noiseTime * body.mass * kGravity;
  const auto surface = body.definition.surfaces.find(motion.object.surface);
  if (surface == body.definition.surfaces.end()) return 0;
  return settings.audibleShare * surface->second.referenceImpulse;
}

}  // namespace

bool isLastAt(const Motion& motion, std::size_t index) {
  return index + 1 >= motion.trajectory.size() ||
         motion.trajectory[index + 1].time > motion.trajectory[index].time + kSameTime;
}

double Evidence::excess(const Eigen::Vector3d& impulse, double duration) const {
  if (motion.cut == EventCut::kPaper) return impulse.norm();
  return std::max(0.0, impulse.norm() - 2 * mass * kGravity * std::max(kBin, duration));
}

Change Evidence::changeBy(const Eigen::Vector3d& impulse, const Eigen::Vector3d& angular,
                          const Eigen::Quaterniond& q) const {
  return {impulse / mass, q * (body.inertia.inverse() * (q.conjugate() * angular))};
}

double Evidence::energy(std::size_t index) const {
  const MotionSample& sample = this->sample(index);
  const Eigen::Vector3d momentum = angularMomentum(sample, body.inertia);
  const double kinetic =
      0.5 * (mass * sample.velocity.squaredNorm() + sample.angularVelocity.dot(momentum));
  return pace[index] * pace[index] * kinetic + mass * kGravity * sample.position.z();
}

Evidence gatherEvidence(const Motion& motion, const Body& body, const AuditSettings& settings) {
  Evidence all{motion, body, settings, body.tolerance(), body.mass, 0, 0, {}, {}, {}, {}};
  all.threshold = eventThreshold(motion, body, settings);
  all.restTime = restTimeOf(motion);
  for (const MotionSample& sample : motion.trajectory) {
    all.lowest.push_back(lowestVertex(sample, body.hull));
  }
  for (std::size_t k = 0; k < motion.contacts.size(); ++k) {
    all.departures.push_back(departureOf(all, k));
  }
  all.pace = paceOf(all);
  for (std::size_t i = 0; i + 1 < motion.trajectory.size(); ++i) {
    all.steps.push_back(makeStep(all, i));
  }
  return all;
}

void Worst::see(double value, double time, std::string detail) {
  if (value <= value_ || std::isnan(value_)) return;
  value_ = value;
  time_ = time;
  detail_ = std::move(detail);
}

AuditCheck Worst::check(std::string name, std::string unit, double limit) const {
  return {std::move(name), value_ <= limit, value_, limit, std::move(unit), time_, detail_};
}

}  // namespace ifa::audit_detail
