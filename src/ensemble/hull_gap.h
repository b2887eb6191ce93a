// SPDX-License-Identifier: Apache-2.0
// How far two convex bodies are apart.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/pose_track.h"

namespace ifa {

/// A convex hull in the body frame, and the radius of the ball about its origin that holds it, m.
struct Hull {
  const std::vector<Eigen::Vector3d>* corners = nullptr;
  double radius = 0;
};

/// A lower bound of the distance between two hulls, by the algorithm of Gilbert, Johnson and
/// Keerthi (1988): exact within a hundredth of a millimetre, or as soon as it is over `enough`; 0
/// where they touch or overlap. Balls around the bodies are tried first.
/// @param enough  m; what is further apart than that need not be known exactly
[[nodiscard]] double hullGap(const Hull& one, const Pose& onePose, const Hull& other,
                             const Pose& otherPose, double enough);

}  // namespace ifa
