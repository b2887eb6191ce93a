// SPDX-License-Identifier: Apache-2.0
#include "audit/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/flight.h"

namespace ifa::audit_detail {
namespace {

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
  // A retimed passage is played slower or faster than simulated; an event's first and last sample
  // belong to such passages with one side each.
  double before = 1, after = 1;
  step.simulated = step.duration;
  if (step.kind == StepKind::kFlight || step.kind == StepKind::kSilent) {
    before = after = all.retiming(step.contact);
    step.simulated /= before;
  } else if (step.kind == StepKind::kEvent) {
    const MotionContact& contact = all.contact(step.contact);
    if (std::abs(a.time - contact.time) < kSameTime && isFirstAt(all.motion, from)) {
      before = all.retiming(step.contact);
    }
    if (std::abs(b.time - contact.end) < kSameTime && isLastAt(all.motion, from + 1)) {
      after = all.retiming(step.contact + 1);
    }
  }
  step.impulse = all.mass * (after * b.velocity - before * a.velocity +
                             step.simulated * kGravity * Eigen::Vector3d::UnitZ());
  return step;
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

bool isFirstAt(const Motion& motion, std::size_t index) {
  return index == 0 ||
         motion.trajectory[index - 1].time < motion.trajectory[index].time - kSameTime;
}

bool isLastAt(const Motion& motion, std::size_t index) {
  return index + 1 >= motion.trajectory.size() ||
         motion.trajectory[index + 1].time > motion.trajectory[index].time + kSameTime;
}

double Evidence::excess(const Eigen::Vector3d& impulse, double duration) const {
  if (motion.cut == EventCut::kPaper) return impulse.norm();
  return std::max(0.0, impulse.norm() - 2 * mass * kGravity * std::max(kBin, duration));
}

double Evidence::energy(const MotionSample& sample, double retiming) const {
  const Eigen::Vector3d momentum = angularMomentum(sample, body.inertia);
  const double kinetic =
      0.5 * (mass * sample.velocity.squaredNorm() + sample.angularVelocity.dot(momentum));
  return retiming * retiming * kinetic + mass * kGravity * sample.position.z();
}

Evidence gatherEvidence(const Motion& motion, const Body& body, const AuditSettings& settings) {
  Evidence all{motion, body, settings, body.tolerance(), body.mass, 0, 0, {}, {}};
  all.threshold = eventThreshold(motion, body, settings);
  all.restTime = restTimeOf(motion);
  for (const MotionSample& sample : motion.trajectory) {
    all.lowest.push_back(lowestVertex(sample, body.hull));
  }
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
