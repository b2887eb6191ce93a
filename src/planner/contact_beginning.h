// SPDX-License-Identifier: Apache-2.0
// Whether a contact can be made by a body that arrives with other velocities than were simulated.
#pragma once

#include "dynamics/body_model.h"
#include "model/rigid_state.h"
#include "sampler/event_recorder.h"

namespace ifa {

/// How a simulated contact begins.
struct ContactBeginning {
  double energy = 0;         ///< after the first impact or step in contact, J
  Eigen::Vector3d first;     ///< velocity then, m/s
  Eigen::Vector3d afterBin;  ///< velocity when the first millisecond is over, or the event
  double time = 0;           ///< from the start to then, s
};

/// Simulates it. @param before  pre-contact state  @param end  of the event, s after it
[[nodiscard]] ContactBeginning beginningOf(const BodyModel& model, const RigidState& before,
                                           double restitution, double end);

/// With the first impulse the arriving body gives way to the simulated one. What the arriving one
/// has not got, the contact must not give it, and it must still be heard.
/// @param arrivalEnergy  J  @param arrivalVelocity  m/s
/// @param depth  to which bodies count as touching, m
[[nodiscard]] bool canBegin(const BodyModel& model, const RecorderSettings& recorder,
                            const ContactBeginning& beginning, double arrivalEnergy,
                            const Eigen::Vector3d& arrivalVelocity, double depth);

}  // namespace ifa
