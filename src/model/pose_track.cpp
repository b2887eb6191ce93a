// SPDX-License-Identifier: Apache-2.0
#include "model/pose_track.h"

#include <algorithm>
#include <cmath>

namespace ifa {
namespace {

// Decision: steps in contact are at most 1 ms long and move at one velocity, so the straight line
// is what was simulated; flight is sampled at 240 Hz and bends in between.
constexpr double kLinearUpTo = 1.5e-3;  // s

Eigen::Vector3d rotationVector(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double sine = q.vec().norm();
  if (sine < 1e-12) return 2 * sign * q.vec();
  return sign * q.vec() * (2 * std::atan2(sine, std::abs(q.w())) / sine);
}

Eigen::Quaterniond rotationBy(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

// Rate of the rotation vector for an angular velocity: the inverse of SO(3)'s left Jacobian.
Eigen::Vector3d rotationVectorRate(const Eigen::Vector3d& vector, const Eigen::Vector3d& omega) {
  const double angle = vector.norm();
  const double coefficient =
      angle < 1e-4
          ? 1.0 / 12
          : (1 - angle * std::cos(angle / 2) / (2 * std::sin(angle / 2))) / (angle * angle);
  const Eigen::Vector3d cross = vector.cross(omega);
  return omega - 0.5 * cross + coefficient * vector.cross(cross);
}

Eigen::Vector3d hermite(double s, double step, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& fromRate, const Eigen::Vector3d& to,
                        const Eigen::Vector3d& toRate) {
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * from + (s3 - 2 * s2 + s) * step * fromRate +
         (3 * s2 - 2 * s3) * to + (s3 - s2) * step * toRate;
}

}  // namespace

Pose PoseTrack::at(double time) const {
  const auto after =
      std::upper_bound(samples_.begin(), samples_.end(), time,
                       [](double t, const MotionSample& sample) { return t < sample.time; });
  if (after == samples_.begin()) return {after->position, after->orientation};
  const MotionSample& from = *(after - 1);
  if (after == samples_.end() || from.time == time) return {from.position, from.orientation};
  const MotionSample& to = *after;
  const double step = to.time - from.time, s = (time - from.time) / step;
  if (step <= kLinearUpTo) {
    return {from.position + s * (to.position - from.position),
            from.orientation.slerp(s, to.orientation)};
  }
  const Eigen::Vector3d turn = rotationVector(to.orientation * from.orientation.conjugate());
  const Eigen::Vector3d turned = hermite(s, step, Eigen::Vector3d::Zero(), from.angularVelocity,
                                         turn, rotationVectorRate(turn, to.angularVelocity));
  return {hermite(s, step, from.position, from.velocity, to.position, to.velocity),
          (rotationBy(turned) * from.orientation).normalized()};
}

}  // namespace ifa
