// SPDX-License-Identifier: Apache-2.0
// Free flight of a rigid body, integrated by the audit's own means.
#pragma once

#include "body/body.h"
#include "ifa/motion.h"

namespace ifa::audit_detail {

/// State `duration` s (>= 0) later in free flight under `gravity` (m/s^2, along -z): a parabola,
/// and torque-free rotation by Runge-Kutta steps of fourth order with the angular momentum held
/// fixed. Angles are good to about 1e-9 rad per turn. World frame; the orientation keeps its sign.
[[nodiscard]] MotionSample flyFreely(const MotionSample& from, double duration, double gravity,
                                     const Eigen::Matrix3d& inertia);

/// Angular momentum about the centre of mass, world frame, kg m^2/s.
[[nodiscard]] Eigen::Vector3d angularMomentum(const MotionSample& sample,
                                              const Eigen::Matrix3d& inertia);

/// Height of the lowest hull vertex above the ground, m.
[[nodiscard]] double lowestVertex(const MotionSample& sample,
                                  const std::vector<Eigen::Vector3d>& hull);

}  // namespace ifa::audit_detail
