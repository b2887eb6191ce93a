// SPDX-License-Identifier: Apache-2.0
#include "dynamics/ode_backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "rolling_prism.h"
#include "sampler/initial_state.h"
#include "support/box_body.h"

namespace ifa {
namespace {

RigidState flatDrop(double height) {
  RigidState state;
  state.position.z() = 0.008 + height;
  return state;
}

double kineticEnergy(const Body& body, const RigidState& state) {
  const Eigen::Vector3d spin = state.orientation.conjugate() * state.angularVelocity;
  return body.mass * state.velocity.squaredNorm() / 2 +
         body.principalMoments.dot(spin.cwiseAbs2()) / 2;
}

class OdeBounce : public testing::TestWithParam<double> {};

TEST_P(OdeBounce, FlatDieReturnsWithTheSurfacesRestitution) {
  const Body die = makeDieBody();
  SurfaceProperties surface;
  surface.restitution = GetParam();
  const DropResult drop = simulateDropOde(die, surface, flatDrop(0.2), 5);
  ASSERT_FALSE(drop.steps.empty());
  const ContactStep& impact = drop.steps.front();
  const double ratio = -impact.after.velocity.z() / impact.before.velocity.z();
  EXPECT_NEAR(ratio, GetParam(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, OdeBounce, testing::Values(0.2, 0.5, 0.8));

TEST(OdeBackend, ImpulsesAccountForEveryChangeOfMomentum) {
  const Body die = makeDieBody();
  const DropResult drop = simulateDropOde(die, {}, sampleInitialState(die, 1, 0), 10);
  ASSERT_GT(drop.steps.size(), 5U);
  for (const ContactStep& step : drop.steps) {
    Eigen::Vector3d change = die.mass * (step.after.velocity - step.before.velocity);
    change.z() += die.mass * kGravity * step.duration;
    EXPECT_LT((change - step.impulse).norm(), 1e-9);
  }
}

TEST(OdeBackend, SlidingDieStopsWhereCoulombSays) {
  const Body die = makeBoxBody({0.04, 0.04, 0.004}, 0.01);
  SurfaceProperties surface;
  surface.restitution = 0;
  surface.friction = 0.3;
  RigidState start;
  start.position.z() = 0.002;
  start.velocity.x() = 1;
  const DropResult drop = simulateDropOde(die, surface, start, 5);
  ASSERT_TRUE(drop.atRest);
  const double expected = 1 / (2 * surface.friction * kGravity);
  EXPECT_NEAR(drop.rest.position.x(), expected, 0.05 * expected);
}

TEST(OdeBackend, RollingAndSpinningFrictionStopASpin) {
  const Body plate = makeBoxBody({0.02, 0.02, 0.002}, 0.01);
  RigidState start;
  start.position.z() = 0.001;
  start.angularVelocity.z() = 20;
  SurfaceProperties surface;
  surface.friction = 0.02;
  const double without = simulateDropOde(plate, surface, start, 10).restTime;
  surface.spinningFriction = 0.002;
  const double with = simulateDropOde(plate, surface, start, 10).restTime;
  EXPECT_LT(with, 0.9 * without);
}

TEST(OdeBackend, RollingPrismLosesWhatItsFacesTake) {
  const RollingPrismCase prism(24, 0.03, 10);
  OdeSettings settings;
  settings.step = 2.5e-4;
  const DropResult drop = simulateDropOde(prism.body, prism.surface, prism.start, 30, settings);
  EXPECT_NEAR(prism.facesRolled(drop.rest), prism.facesByTheBook(), 2);
}

TEST(OdeBackend, EveryDropComesToRestOnTheGround) {
  const Body die = makeDieBody();
  for (std::uint64_t i = 0; i < 100; ++i) {
    const DropResult drop = simulateDropOde(die, {}, sampleInitialState(die, 2, i), 10);
    ASSERT_TRUE(drop.atRest) << i;
    EXPECT_LT(kineticEnergy(die, drop.rest), 0.5 * die.mass * 0.02 * 0.02);
    EXPECT_NEAR(drop.rest.position.z(), 0.008, 1e-4) << i;
    EXPECT_LE(drop.steps.back().time, drop.restTime + 0.051);
  }
}

TEST(OdeBackend, TimeLimitIsKept) {
  const Body die = makeDieBody();
  const DropResult drop = simulateDropOde(die, {}, flatDrop(1), 0.1);
  EXPECT_FALSE(drop.atRest);
  EXPECT_DOUBLE_EQ(drop.restTime, 0.1);
  EXPECT_TRUE(drop.steps.empty());
}

bool sameBits(const RigidState& a, const RigidState& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs() &&
         a.velocity == b.velocity && a.angularVelocity == b.angularVelocity;
}

TEST(OdeBackend, DoesNotDependOnRecordingOrOnOtherThreads) {
  const Body die = makeDieBody();
  constexpr std::size_t kDrops = 40;
  std::vector<RigidState> alone(kDrops), lean(kDrops), first(kDrops), second(kDrops);
  OdeSettings noSteps;
  noSteps.recordSteps = false;
  const auto simulate = [&](std::vector<RigidState>& rest, const OdeSettings& settings) {
    for (std::size_t i = 0; i < kDrops; ++i)
      rest[i] = simulateDropOde(die, {}, sampleInitialState(die, 3, i), 10, settings).rest;
  };
  simulate(alone, {});
  simulate(lean, noSteps);
  std::thread other([&] { simulate(first, {}); });
  simulate(second, noSteps);
  other.join();
  for (std::size_t i = 0; i < kDrops; ++i) {
    EXPECT_TRUE(sameBits(alone[i], lean[i])) << i;
    EXPECT_TRUE(sameBits(alone[i], first[i])) << i;
    EXPECT_TRUE(sameBits(alone[i], second[i])) << i;
  }
}

TEST(OdeBackend, ManyVerticesAreThinnedBySpread) {
  Body disc = makeBoxBody({0.08, 0.08, 0.01}, 0.05);
  disc.hull.clear();
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 48;
    for (const double z : {-0.005, 0.005})
      disc.hull.emplace_back(0.04 * std::cos(angle), 0.04 * std::sin(angle), z);
  }
  RigidState start;
  start.position.z() = 0.01;
  const DropResult drop = simulateDropOde(disc, {}, start, 5);
  ASSERT_TRUE(drop.atRest);
  EXPECT_NEAR(drop.rest.position.z(), 0.005, 1e-4);
  EXPECT_GT((drop.rest.orientation * Eigen::Vector3d::UnitZ()).z(), 0.9999);
}

}  // namespace
}  // namespace ifa
