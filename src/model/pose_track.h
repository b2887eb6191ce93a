// SPDX-License-Identifier: Apache-2.0
// The pose of a motion at any time, between its samples too.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "ifa/motion.h"

namespace ifa {

/// World from body; world frame as in motion.json, m.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Cubic Hermite interpolation from the samples' velocities in flight (a parabola comes out
/// exactly), linear in the short steps of contacts. Before the first and after the last sample the
/// pose is held. Holds a reference to `motion`, which must have samples.
class PoseTrack {
 public:
  explicit PoseTrack(const Motion& motion) : samples_(motion.trajectory) {}

  /// @param time  s after the first contact
  [[nodiscard]] Pose at(double time) const;
  [[nodiscard]] double start() const { return samples_.front().time; }
  [[nodiscard]] double end() const { return samples_.back().time; }

 private:
  const std::vector<MotionSample>& samples_;
};

}  // namespace ifa
