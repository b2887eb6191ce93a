// SPDX-License-Identifier: Apache-2.0
// Whole connections: simulated flights must come out as they were, others must lead where they say.
#include "connection/connection.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "affinity/factors.h"
#include "connection/connection_cases.h"
#include "connection/linear_connection.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using test::SimulatedFlight;

TEST(LinearConnection, IsThePrintedParabola) {
  const Vector3d from(0.1, 0.2, 0.01), to(-0.3, 0.1, 0.02);
  const double time = 0.17;
  const Vector3d v = linearConnection(from, to, time), g(0, 0, -kGravity);
  EXPECT_LT((from + v * time + 0.5 * time * time * g - to).norm(), 1e-15);
}

/// On each ground: all moments equal, none equal, two equal.
class Connections : public testing::TestWithParam<std::size_t> {
 protected:
  Connections()
      : ground_(test::grounds()[GetParam()]),
        model_(ground_.body, ground_.surface),
        flights_(test::simulatedFlights(ground_, model_, 300)) {
    exact_.depth = printed_.depth = ground_.body.tolerance();
  }

  /// Contact of one flight, then that of another, somewhere else on the plane and a little off.
  ConnectionEnds endsOf(std::size_t i, double off) {
    const SimulatedFlight& flight = flights_[i];
    ConnectionEnds ends = connectionEnds(flight.first, flight.first, flight.next);
    const double half = random_.uniform(-3, 3);
    const PlanarTransform away{std::cos(half), std::sin(half), 0.3, -0.2};
    ends.sibling = away.apply(ends.sibling);
    ends.target = away.apply(ends.target);
    const Vector3d turn = test::randomVector(random_, off);
    ends.source.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) *
        ends.source.orientation;
    ends.source.velocity += test::randomVector(random_, off);
    ends.source.angularVelocity *= 1 + random_.uniform(-off, off);
    ends.source.position.z() -= test::ReferenceFlight(ground_.body, ends.source).clearance();
    return ends;
  }

  test::Ground ground_;
  BodyModel model_;
  std::vector<SimulatedFlight> flights_;
  ConnectionSettings exact_, printed_ = ConnectionSettings::printed();
  RandomStream random_{41, 42};
};

TEST_P(Connections, SimulatedFlightsComeBackAsTheyWere) {
  ASSERT_GT(flights_.size(), 200U);
  double linear = 0, angular = 0;
  int made = 0;
  for (const SimulatedFlight& flight : flights_) {
    ConnectionEnds ends = connectionEnds(flight.first, flight.first, flight.next);
    const PlanarTransform away{0.6, 0.8, 0.3, -0.2};
    ends.sibling = away.apply(ends.sibling);
    ends.target = away.apply(ends.target);
    for (const RegisterAt where : {RegisterAt::kArrival, RegisterAt::kDeparture}) {
      exact_.registerAt = where;
      const Connection c = connect(model_, ends, flight.time(), exact_);
      ASSERT_TRUE(c.made()) << describe(c.failure) << " " << c.underAt << " of " << flight.time();
      ++made;
      linear = std::max(linear, (c.departure.velocity - flight.first.after.velocity).norm());
      angular = std::max(angular,
                         (c.departure.angularVelocity - flight.first.after.angularVelocity).norm());
      EXPECT_LT(c.registration.angle, 1e-6);
      EXPECT_LT((c.arrival.velocity - c.target.velocity).norm(), 1e-6);
      EXPECT_LT((c.arrival.angularVelocity - c.target.angularVelocity).norm(), 1e-5);
    }
    const Connection blend = connect(model_, ends, flight.time(), printed_);
    ASSERT_TRUE(blend.made()) << describe(blend.failure);
    EXPECT_LT(blend.time.amount(), 1e-12);
    EXPECT_EQ(logTimeWarp(flight.time(), blend.time.flightTime), 0);
  }
  std::printf("%d made; velocities within %.1e m/s, %.1e rad/s\n", made, linear, angular);
  EXPECT_LT(linear, 1e-6);
  EXPECT_LT(angular, 1e-6);
}

TEST_P(Connections, ExactOnesLandOnTimeAndInPlace) {
  int made = 0, under = 0, lost = 0;
  for (std::size_t i = 0; i < flights_.size(); i += 3) {
    const ConnectionEnds ends = endsOf(i, 0.1);
    const double target = ends.time * random_.uniform(0.9, 1.1);
    exact_.registerAt = i % 2 ? RegisterAt::kArrival : RegisterAt::kDeparture;
    const Connection c = connect(model_, ends, target, exact_);
    under += c.failure == ConnectionFailure::kUnderGround;
    lost += c.failure == ConnectionFailure::kNotConverged;
    if (!c.made()) continue;
    ++made;
    EXPECT_EQ(c.time.stretch(), 1);
    const RigidState end = test::integrated(ground_.body, c.departure, target);
    EXPECT_LT((end.position - c.target.position).norm(), 1e-12);
    EXPECT_LT(test::angleBetween(end.orientation, c.target.orientation), 1e-6);
    EXPECT_LT((end.velocity - c.arrival.velocity).norm(), 1e-12);
    EXPECT_LT((end.angularVelocity - c.arrival.angularVelocity).norm(), 1e-4);
    const RigidState shown = stateAt(model_, c, target);
    EXPECT_LT((shown.position - c.target.position).norm(), 1e-12);
    EXPECT_LT(test::angleBetween(shown.orientation, c.target.orientation), 1e-9);
    EXPECT_EQ(c.departure.position, ends.source.position);
    EXPECT_EQ(c.departure.orientation.coeffs(), ends.source.orientation.coeffs());
  }
  std::printf("%d made, %d under the ground, %d without a spin\n", made, under, lost);
  EXPECT_GT(made, 40);
  EXPECT_LT(lost, 0.1 * (made + under + lost));
}

TEST_P(Connections, WhatIsMadeStaysAboveTheGround) {
  for (std::size_t i = 0; i < flights_.size(); i += 25) {
    const ConnectionEnds ends = endsOf(i, 0.1);
    const Connection c = connect(model_, ends, ends.time, exact_);
    if (!c.made()) continue;
    test::ReferenceFlight flight(ground_.body, c.departure);
    double lowest = 1e9;
    for (double t = 0; t < ends.time; t += 1e-5, flight.advance(1e-5))
      lowest = std::min(lowest, flight.clearance());
    EXPECT_GT(lowest, -ground_.body.tolerance() - 1e-4 * ground_.body.radius);
  }
}

TEST_P(Connections, BlendedOnesAreWarpedAfterwards) {
  for (std::size_t i = 0; i < flights_.size(); i += 10) {
    const ConnectionEnds ends = endsOf(i, 0.02);
    const Connection own = connect(model_, ends, ends.time, printed_);
    const Connection c = connect(model_, ends, 1.2 * ends.time, printed_);
    EXPECT_EQ(own.failure, c.failure);
    if (!c.made()) continue;
    EXPECT_EQ(c.departure.velocity, own.departure.velocity);
    EXPECT_EQ(c.departure.angularVelocity, own.departure.angularVelocity);
    EXPECT_NEAR(c.time.amount(), 0.2, 1e-12);
    const double t = 0.4 * ends.time;
    const RigidState slow = stateAt(model_, c, 1.2 * t), fast = stateAt(model_, own, t);
    EXPECT_LT((slow.position - fast.position).norm(), 1e-12);
    EXPECT_LT(test::angleBetween(slow.orientation, fast.orientation), 1e-9);
    EXPECT_LT((1.2 * slow.velocity - fast.velocity).norm(), 1e-12);
    EXPECT_LT((1.2 * slow.angularVelocity - fast.angularVelocity).norm(), 1e-8);
  }
}

TEST_P(Connections, SayWhyTheyFail) {
  const auto failure = [&](const ConnectionEnds& ends, double target, const auto& settings) {
    return connect(model_, ends, target, settings).failure;
  };
  ConnectionEnds ends = endsOf(0, 0);
  EXPECT_EQ(failure(ends, 0, exact_), ConnectionFailure::kNoTime);
  EXPECT_EQ(failure(ends, -1, printed_), ConnectionFailure::kNoTime);
  EXPECT_EQ(failure(ends, 1.31 * ends.time, printed_), ConnectionFailure::kTimeWarp);
  EXPECT_EQ(failure(ends, ends.time / 1.31, printed_), ConnectionFailure::kTimeWarp);
  ConnectionSettings hasty = printed_;
  hasty.shooting.mostSteps = 0;
  hasty.shooting.tolerance = 0;
  EXPECT_EQ(failure(ends, ends.time, hasty), ConnectionFailure::kNotConverged);
  ends.target.position.z() = -0.2;
  EXPECT_EQ(failure(ends, ends.time, exact_), ConnectionFailure::kUnderGround);
  ends.flight = false;
  EXPECT_EQ(failure(ends, ends.time, exact_), ConnectionFailure::kNotFlight);
}

INSTANTIATE_TEST_SUITE_P(Grounds, Connections, testing::Values(0, 1, 2));

}  // namespace
}  // namespace ifa
