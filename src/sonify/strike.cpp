// SPDX-License-Identifier: Apache-2.0
#include "sonify/strike.h"

#include <algorithm>
#include <cmath>

namespace ifa {
namespace {

constexpr double kBin = 1e-3;  // s, docs/method.md 2
/// Samples of a motion further apart than this are of a flight, s (docs/file-formats.md).
constexpr double kLongestStep = 1.5e-3;
/// Change of speed under which rounding is all that a blow would be, m/s.
constexpr double kSlowest = 1e-6;

/// The hull's corner that is lowest.
Eigen::Vector3d lowestPoint(const Body& body, const Eigen::Vector3d& up) {
  return *std::min_element(
      body.hull.begin(), body.hull.end(),
      [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.dot(up) < b.dot(up); });
}

/// Adds the blow of `impulse` (world frame) unless it carries the weight and no more.
void addStrike(std::vector<Strike>& strikes, const Body& body, double time, double duration,
               const Eigen::Vector3d& impulse, const Eigen::Matrix3d& bodyFromWorld) {
  const double length = impulse.norm();
  const double carried = 2 * body.mass * kGravity * std::max(kBin, duration);
  const double sounding = duration > 0 ? length - carried : length;
  if (sounding <= body.mass * kSlowest) return;
  Strike strike;
  strike.time = time;
  strike.duration = duration;
  strike.impulse = sounding;
  strike.direction = bodyFromWorld * (impulse / length);
  strike.point = lowestPoint(body, bodyFromWorld.col(2));
  strikes.push_back(strike);
}

}  // namespace

std::vector<Strike> strikesOf(const Motion& motion, const Body& body) {
  std::vector<Strike> strikes;
  const auto& samples = motion.trajectory;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const MotionSample& from = samples[i - 1];
    const MotionSample& to = samples[i];
    const double duration = to.time - from.time;
    if (duration > kLongestStep) continue;
    const Eigen::Vector3d fall(0, 0, -kGravity * duration);
    const Eigen::Vector3d impulse = body.mass * (to.velocity - from.velocity - fall);
    addStrike(strikes, body, from.time, duration, impulse,
              from.orientation.toRotationMatrix().transpose());
  }
  return strikes;
}

std::vector<Strike> strikesOf(const std::vector<ContactStep>& steps, const Body& body) {
  std::vector<Strike> strikes;
  for (const ContactStep& step : steps) {
    const Eigen::Matrix3d worldFromBody =
        step.before.orientation.toRotationMatrix() * body.bodyFromPrincipal.transpose();
    addStrike(strikes, body, step.time, step.duration, step.impulse, worldFromBody.transpose());
  }
  return strikes;
}

}  // namespace ifa
