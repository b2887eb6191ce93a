// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "audit/checks.h"
#include "audit/flight.h"

namespace ifa::audit_detail {
namespace {

// Longer steps where the body may touch but need not are flight too: contact has 1 ms at most.
constexpr double kLongestContactStep = 1e-3 + 1e-6;  // s
constexpr double kSlowest = 1e-3;  // rad/s; under it angular momentum has no direction

bool mustFly(const Step& step) {
  const bool free = step.kind == StepKind::kSilent || step.kind == StepKind::kAfter;
  return step.kind == StepKind::kFlight || (free && step.simulated > kLongestContactStep);
}

double relativeChange(const Eigen::Vector3d& before, const Eigen::Vector3d& after, double floor) {
  return (after - before).norm() / std::max(before.norm(), floor);
}

}  // namespace

void checkFlight(const Evidence& all, Checks& checks) {
  Worst position, angle, velocity, momentum, warp;
  for (const MotionContact& contact : all.motion.contacts) {
    warp.see(std::max(contact.retiming, 1 / contact.retiming) - 1, contact.time);
  }
  const Eigen::Matrix3d& inertia = all.body.inertia;
  const double floor = kSlowest * inertia.trace() / 3;
  for (const Step& step : all.steps) {
    if (!mustFly(step)) continue;
    const MotionSample &from = all.sample(step.from), &to = all.sample(step.from + 1);
    const double retiming = all.retiming(step.contact);
    const MotionSample there =
        flyFreely(from, step.duration, kGravity / (retiming * retiming), inertia);
    position.see((there.position - to.position).norm(), to.time);
    angle.see(there.orientation.angularDistance(to.orientation), to.time);
    velocity.see((there.velocity - to.velocity).norm(), to.time);
    momentum.see(
        relativeChange(angularMomentum(from, inertia), angularMomentum(to, inertia), floor),
        to.time);
  }
  checks.push_back(position.check("flight position", "m", all.settings.flightPosition));
  checks.push_back(angle.check("flight angle", "rad", all.settings.flightAngle));
  checks.push_back(velocity.check("flight velocity", "m/s", all.settings.flightVelocity));
  checks.push_back(momentum.check("angular momentum", "", all.settings.angularMomentum));
  checks.push_back(warp.check("time warp", "share", all.settings.timeWarp));
}

void checkGround(const Evidence& all, Checks& checks) {
  constexpr double kLargestTurn = 0.02;  // rad between looks
  Worst depth;
  for (std::size_t i = 0; i < all.lowest.size(); ++i) depth.see(-all.lowest[i], all.sample(i).time);
  for (const Step& step : all.steps) {
    // From higher than it can turn and fall down, no vertex reaches the ground.
    const MotionSample& from = all.sample(step.from);
    const double speed = from.velocity.norm() + from.angularVelocity.norm() * all.body.radius * 4 +
                         kGravity * step.duration;
    if (!mustFly(step) || all.lowest[step.from] > speed * step.duration) continue;
    const double retiming = all.retiming(step.contact);
    const double looks =
        std::min(1e4, 4 + std::ceil(from.angularVelocity.norm() * step.duration / kLargestTurn));
    MotionSample at = from;
    for (double i = 1; i < looks; ++i) {
      at = flyFreely(at, step.duration / looks, kGravity / (retiming * retiming), all.body.inertia);
      depth.see(-lowestVertex(at, all.body.hull), at.time);
    }
  }
  checks.push_back(depth.check("lowest vertex", "m below ground", all.depth));
}

}  // namespace ifa::audit_detail
