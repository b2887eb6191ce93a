// SPDX-License-Identifier: Apache-2.0
// Bodies, flights and pairs of contacts that the tests of connections share.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "connection/connection.h"
#include "dynamics/simulator.h"
#include "planner/bodies.h"
#include "planner/reference_flight.h"

namespace ifa::test {

/// Box whose moments of inertia are as 1 : 2 : 3.
inline Body makeTumbler() {
  Body body = makeBoxBody({0.05, 0.03, 0.015}, 0.02);
  body.principalMoments = Eigen::Vector3d(1, 2, 3) * 2e-6;
  body.inertia = body.principalMoments.asDiagonal();
  return body;
}

inline double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return 2 * std::asin(std::min(1.0, (a.conjugate() * b).vec().norm()));
}

inline Eigen::Quaterniond randomOrientation(RandomStream& random) {
  Eigen::Vector4d c;
  do {
    for (int k = 0; k < 4; ++k) c[k] = random.uniform(-1, 1);
  } while (c.squaredNorm() > 1 || c.squaredNorm() < 0.01);
  return Eigen::Quaterniond(c.normalized());
}

/// Anywhere a metre up, up to 100 rad/s.
inline RigidState randomState(RandomStream& random) {
  RigidState state;
  state.position = Eigen::Vector3d(0, 0, 1) + randomVector(random, 0.2);
  state.orientation = randomOrientation(random);
  state.velocity = randomVector(random, 2);
  state.angularVelocity = randomVector(random, 57);
  return state;
}

inline RigidState integrated(const Body& body, const RigidState& start, double duration) {
  ReferenceFlight flight(body, start);
  flight.advance(duration);
  return flight.state();
}

/// Two contacts of one drop with nothing but flight between them.
struct SimulatedFlight {
  ContactEvent first, next;

  [[nodiscard]] double time() const { return next.start - first.end; }
};

/// What of the drops' passages is flight: nothing touches, however softly, between the two.
inline std::vector<SimulatedFlight> simulatedFlights(const Ground& ground, const BodyModel& model,
                                                     std::uint64_t drops) {
  std::vector<SimulatedFlight> flights;
  for (std::uint64_t d = 0; d < drops; ++d) {
    const DropResult drop = simulateDrop(model, sampleInitialState(ground.body, 23, d), 20);
    const auto events = eventsOf(drop, audibleCut(ground.body, ground.surface));
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {
      const SimulatedFlight flight{events[i], events[i + 1]};
      const bool soft = std::any_of(drop.steps.begin(), drop.steps.end(), [&](const auto& step) {
        return step.time > flight.first.end + 1e-9 && step.time < flight.next.start - 1e-9;
      });
      if (!soft && !flight.first.touchingAfter && flight.time() > 1e-3) flights.push_back(flight);
    }
  }
  return flights;
}

}  // namespace ifa::test
