// SPDX-License-Identifier: Apache-2.0
// Sinking into the ground in flight, against looking every 10 microseconds.
#include "connection/ground_clearance.h"

#include <gtest/gtest.h>

#include "connection/connection_cases.h"

namespace ifa {
namespace {

constexpr double kStep = 1e-5;  // s
// m: what the cubic of a height may be off (7e-5 r), plus what is missed between two looks.
double blurOf(const Body& body) { return 7e-5 * body.radius + 1e-8; }

struct Sampled {
  double lowest = 1e9;  ///< m, over the flight
  double first = -1;    ///< s, when it was first under -depth; -1 for never
};

Sampled sampled(const Body& body, const RigidState& start, double duration, double depth) {
  test::ReferenceFlight flight(body, start);
  Sampled seen;
  for (double t = 0; t < duration; t += kStep) {
    const double height = flight.clearance();
    seen.lowest = std::min(seen.lowest, height);
    if (seen.first < 0 && height < -depth) seen.first = t;
    flight.advance(kStep);
  }
  return seen;
}

/// Departures from the ground that rise, some of them only just.
RigidState departure(RandomStream& random, const Body& body) {
  RigidState state;
  state.orientation = test::randomOrientation(random);
  state.velocity = {0.2, 0, random.uniform(0.05, 1.2)};
  state.angularVelocity = test::randomVector(random, 57);
  state.position.z() -= test::ReferenceFlight(body, state).clearance();
  return state;
}

TEST(GroundClearance, IsWhatSamplingFinds) {
  RandomStream random(31, 32);
  for (const Body& body :
       {makeDieBody(), makePrismBody(24, 0.02, 0.06, 0.1), test::makeTumbler()}) {
    const BodyModel model(body, {});
    const double depth = body.tolerance();
    int under = 0, above = 0, close = 0;
    for (int i = 0; i < 150; ++i) {
      const RigidState start = departure(random, body);
      const double duration = 1.8 * start.velocity.z() / kGravity * random.uniform(0.4, 1);
      const Sampled seen = sampled(body, start, duration, depth);
      const auto found = goesUnder(model, start, duration, depth);
      if (std::abs(seen.lowest + depth) < blurOf(body) + 2e-7) {
        ++close;  // sampling cannot tell
        continue;
      }
      ASSERT_EQ(found.has_value(), seen.first >= 0) << i << " lowest " << seen.lowest;
      ++(found ? under : above);
      if (!found) continue;
      test::ReferenceFlight there(body, start);
      there.advance(*found);
      EXPECT_NEAR(there.clearance(), -depth, blurOf(body)) << i;
      EXPECT_LT(*found, seen.first + 1e-9) << i;
    }
    EXPECT_GT(under, 5) << body.definition.name;
    EXPECT_GT(above, 20) << body.definition.name;
    EXPECT_LT(close, 5);
  }
}

TEST(GroundClearance, SinkingFromTheStartIsSeenAtOnceUnlessItIsShallow) {
  const Body die = makeDieBody();
  const BodyModel model(die, {});
  RigidState state;
  state.position.z() = 0.008 - 2e-4;
  state.velocity.z() = -0.1;
  ASSERT_TRUE(goesUnder(model, state, 0.1, 1e-4).has_value());
  EXPECT_EQ(*goesUnder(model, state, 0.1, 1e-4), 0);
  EXPECT_FALSE(goesUnder(model, state, 1e-4, 3e-4).has_value());
}

}  // namespace
}  // namespace ifa
