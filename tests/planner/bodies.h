// SPDX-License-Identifier: Apache-2.0
// Bodies, and states after real contacts, that the planner's tests share.
#pragma once

#include <limits>
#include <vector>

#include "base/random.h"
#include "dynamics/body_model.h"
#include "planner/event_simulation.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"
#include "support/box_body.h"

namespace ifa::test {

struct Ground {
  Body body;
  SurfaceProperties surface;
};

/// Surface on which a body is heard from a hundredth of its fall at 2 m/s.
inline SurfaceProperties surfaceOf(const Body& body, double restitution) {
  SurfaceProperties surface;
  surface.restitution = restitution;
  surface.friction = 0.35;
  surface.rollingFriction = surface.spinningFriction = 2e-4;
  surface.referenceImpulse = body.mass * 2 * (1 + restitution);
  return surface;
}

inline Ground onGround(const Body& body, double restitution) {
  return {body, surfaceOf(body, restitution)};
}

/// All moments equal, none equal, two equal; the last many-cornered.
inline std::vector<Ground> grounds() {
  return {onGround(makeDieBody(), 0.75), onGround(makeBoxBody({0.060, 0.022, 0.012}, 0.02), 0.4),
          onGround(makePrismBody(20, 0.03, 0.08, 0.2), 0.55)};
}

/// A number of first contacts of sampled drops that are heard and do not come to rest.
inline std::vector<ContactEvent> firstContacts(const Ground& ground, const BodyModel& model,
                                               std::size_t count) {
  EventSimulation simulation(model, audibleCut(ground.body, ground.surface));
  std::vector<ContactEvent> all, ways;
  for (std::uint64_t i = 0; all.size() < count && i < 20 * count; ++i) {
    simulation.outcomes(sampleInitialState(ground.body, 11, i), ground.surface.restitution, false,
                        false, ways);
    if (!ways.empty()) all.push_back(ways[0]);
  }
  return all;
}

inline Eigen::Vector3d randomVector(RandomStream& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

inline bool sameBits(const RigidState& a, const RigidState& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs() &&
         a.velocity == b.velocity && a.angularVelocity == b.angularVelocity;
}

inline constexpr double kAnyEnergy = std::numeric_limits<double>::infinity();

}  // namespace ifa::test
