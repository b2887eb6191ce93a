// SPDX-License-Identifier: Apache-2.0
// The blows of which a motion's sound is made.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "body/body.h"
#include "ifa/motion.h"
#include "model/contact_step.h"

namespace ifa {

/// One blow of the floor against the body.
struct Strike {
  double time = 0;      ///< s; of a motion: after its first contact
  double duration = 0;  ///< s; somewhere in it the blow falls. 0: at `time`
  double impulse = 0;   ///< N s, what of it sounds (docs/method.md 2)
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of the impulse, body frame
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< body frame, m
};

/// All blows of a motion in order of time, inside events and between them. Every sudden change of
/// velocity is one, and so is every step in contact that does more than carry the weight.
[[nodiscard]] std::vector<Strike> strikesOf(const Motion& motion, const Body& body);

/// The same of a simulated drop; times are the simulation's.
[[nodiscard]] std::vector<Strike> strikesOf(const std::vector<ContactStep>& steps,
                                            const Body& body);

}  // namespace ifa
