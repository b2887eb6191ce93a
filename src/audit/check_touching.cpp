// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "audit/checks.h"
#include "audit/flight.h"

namespace ifa::audit_detail {
namespace {

// Share of h by which a step of 1 ms may leave what the velocities say: its turn is not quite even.
constexpr double kRoundedStep = 0.2;

/// Impulses below this neither push nor pull: rounding, N s.
double noImpulse(const Evidence& all) { return all.settings.noiseTime * all.mass * kGravity; }

/// Coming to rest is not among them: what little motion is left then is cut ("rest speed").
bool isQuiet(const Step& step) {
  return step.kind == StepKind::kSilent || step.kind == StepKind::kAfter;
}

/// An impulse without a vertex at the ground comes from nowhere.
AuditCheck onTheGround(const Evidence& all) {
  Worst worst;
  for (const Step& step : all.steps) {
    if (!isQuiet(step) || step.impulse.norm() <= noImpulse(all)) continue;
    worst.see(std::min(std::abs(all.lowest[step.from]), std::abs(all.lowest[step.from + 1])),
              all.sample(step.from).time);
  }
  return worst.check("touching on the ground", "m from ground", all.depth);
}

/// By how much of itself an impulse leaves the friction cone; pulling counts in full.
AuditCheck frictionCone(const Evidence& all) {
  Worst worst;
  for (const Step& step : all.steps) {
    const double size = step.impulse.norm();
    if (!isQuiet(step) || size <= noImpulse(all)) continue;
    const double normal = step.impulse.z(), tangential = step.impulse.head<2>().norm();
    const double outside = std::max(tangential - all.motion.object.friction * normal, -normal);
    worst.see((outside - noImpulse(all)) / size, all.sample(step.from).time);
  }
  return worst.check("friction cone", "share", all.settings.frictionMargin);
}

/// Distance of `x` from the straight way between `a` and `b`.
double distanceFromWay(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b) {
  const Eigen::Vector3d way = b - a;
  const double squared = way.squaredNorm();
  const double share = squared > 0 ? std::clamp((x - a).dot(way) / squared, 0.0, 1.0) : 0.0;
  return (x - a - share * way).norm();
}

Eigen::Vector3d turn(const MotionSample& from, const MotionSample& to) {
  const Eigen::AngleAxisd difference(to.orientation * from.orientation.conjugate());
  return difference.angle() * difference.axis();
}

/// Distance by which a surface point of one pose misses that of the other, at most, m.
double poseDifference(const Evidence& all, const MotionSample& a, const MotionSample& b) {
  return (a.position - b.position).norm() +
         all.body.radius * a.orientation.angularDistance(b.orientation);
}

/// How far a step's end lies from where something between the velocity before and the one after
/// would have carried the body, or from where it would have flown, m.
double displacement(const Evidence& all, const Step& step) {
  const MotionSample &from = all.sample(step.from), &to = all.sample(step.from + 1);
  const double moved = distanceFromWay(to.position - from.position, step.duration * from.velocity,
                                       step.duration * to.velocity);
  const double turned = distanceFromWay(turn(from, to), step.duration * from.angularVelocity,
                                        step.duration * to.angularVelocity);
  const double played = step.simulated > 0 ? step.simulated / step.duration : 1;
  const MotionSample flown =
      flyFreely(from, step.duration, kGravity * played * played, all.body.inertia);
  return std::min(moved + all.body.radius * turned, poseDifference(all, flown, to));
}

/// Poses move as velocities say. What is beyond is displacement by hand.
AuditCheck motionInContact(const Evidence& all) {
  Worst worst;
  for (const Step& step : all.steps) {
    if (step.kind == StepKind::kFlight || step.kind == StepKind::kRest) continue;
    if (step.duration < kSameTime || step.simulated > kBin + 1e-6) continue;
    worst.see(displacement(all, step), all.sample(step.from).time);
  }
  return worst.check("motion in contact", "m", kRoundedStep * all.depth);
}

}  // namespace

void checkTouching(const Evidence& all, Checks& checks) {
  checks.push_back(onTheGround(all));
  checks.push_back(frictionCone(all));
  checks.push_back(motionInContact(all));
}

}  // namespace ifa::audit_detail
