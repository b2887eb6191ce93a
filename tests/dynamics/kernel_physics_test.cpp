// SPDX-License-Identifier: Apache-2.0
// The kernel against textbook results.
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/simulator.h"
#include "kernel_drops.h"
#include "rolling_prism.h"
#include "support/box_body.h"

namespace ifa {
namespace {

class Bounce : public testing::TestWithParam<double> {};

TEST_P(Bounce, FlatDieRisesToTheSquareOfRestitution) {
  const Body die = makeDieBody();
  SurfaceProperties surface;
  surface.restitution = GetParam();
  RigidState start;
  start.position.z() = 0.008 + 0.3;
  const DropResult drop = simulateDrop(die, surface, start, 0.4);
  ASSERT_FALSE(drop.steps.empty());
  const double up = drop.steps.front().after.velocity.z();
  EXPECT_NEAR(up * up / (2 * kGravity), GetParam() * GetParam() * 0.3,
              0.02 * GetParam() * GetParam() * 0.3);
  EXPECT_FALSE(drop.steps.front().touching) << "it bounced off";
}

INSTANTIATE_TEST_SUITE_P(Restitutions, Bounce,
                         testing::Values(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95));

class Slide : public testing::TestWithParam<double> {};

TEST_P(Slide, PlateStopsWhereCoulombSays) {
  const Body plate = makeBoxBody({0.04, 0.04, 0.004}, 0.01);
  SurfaceProperties surface;
  surface.restitution = 0.5;
  surface.friction = GetParam();
  RigidState start;
  start.position.z() = 0.002;
  start.velocity = {0.8, 0.6, 0};
  const DropResult drop = simulateDrop(plate, surface, start, 20);
  ASSERT_TRUE(drop.atRest);
  const double expected = 1 / (2 * surface.friction * kGravity);
  EXPECT_NEAR(drop.rest.position.head<2>().norm(), expected, 0.02 * expected);
  EXPECT_NEAR(drop.restTime, 1 / (surface.friction * kGravity), 0.03 / surface.friction);
}

INSTANTIATE_TEST_SUITE_P(Frictions, Slide, testing::Values(0.05, 0.1, 0.2, 0.3, 0.5));

TEST(KernelPhysics, SpinningFrictionBrakesAsItsArmSays) {
  const Body plate = makeBoxBody({0.02, 0.02, 0.002}, 0.01);
  SurfaceProperties surface;
  surface.friction = 0;
  surface.spinningFriction = 0.001;
  RigidState start;
  start.position.z() = 0.001;
  start.angularVelocity.z() = 20;
  const DropResult drop = simulateDrop(plate, surface, start, 20);
  ASSERT_TRUE(drop.atRest);
  const double braking =
      surface.spinningFriction * plate.mass * kGravity / plate.principalMoments.z();
  // Rest is declared at the kernel's rest speed.
  const double left =
      KernelSettings{}.restSpeed * std::sqrt(plate.mass / plate.principalMoments.z());
  EXPECT_NEAR(drop.restTime, (20 - left) / braking, 0.02 * 20 / braking);
}

struct Roll {
  int sides;
  double spin;
  int tolerance;
};

class RollingPrism : public testing::TestWithParam<Roll> {};

TEST_P(RollingPrism, LosesWhatItsFacesTake) {
  const auto [sides, spin, tolerance] = GetParam();
  const RollingPrismCase prism(sides, 0.03, spin);
  const DropResult drop = simulateDrop(prism.body, prism.surface, prism.start, 60);
  ASSERT_TRUE(drop.atRest);
  EXPECT_NEAR(prism.facesRolled(drop.rest), prism.facesByTheBook(), tolerance + 0.01);
}

INSTANTIATE_TEST_SUITE_P(Prisms, RollingPrism,
                         testing::Values(Roll{8, 12, 0}, Roll{12, 15, 0}, Roll{24, 10, 4}));

/// A plate that is put on its long edge, its centre of mass `offset` m beside it.
RigidState onEdge(double halfWidth, double halfHeight, double offset) {
  const double tilt =
      std::atan2(halfWidth, halfHeight) - offset / std::hypot(halfWidth, halfHeight);
  RigidState state;
  state.orientation = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX());
  state.position.z() = halfHeight * std::cos(tilt) + halfWidth * std::sin(tilt);
  return state;
}

class Topple : public testing::TestWithParam<double> {};

TEST_P(Topple, NothingFreezesOnAnEdge) {
  const Body box = makeBoxBody({0.05, 0.02, 0.03}, 0.02);
  SurfaceProperties surface;
  surface.restitution = 0.3;
  surface.friction = 0.5;
  const DropResult drop = simulateDrop(box, surface, onEdge(0.01, 0.015, GetParam()), 20);
  ASSERT_TRUE(drop.atRest);
  const Eigen::Vector3d up = drop.rest.orientation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_GT(up.cwiseAbs().maxCoeff(), 0.999) << "it lies on no face";
}

INSTANTIATE_TEST_SUITE_P(Offsets, Topple, testing::Values(1e-3, 1e-4, 1e-5, -1e-5, -1e-4));

TEST(KernelPhysics, ImpulsesAccountForEveryChangeOfMomentum) {
  const Body box = makeBoxBody({0.05, 0.02, 0.03}, 0.02);
  SurfaceProperties surface;
  surface.restitution = 0.6;
  RigidState start;
  start.position.z() = 0.2;
  start.angularVelocity = {7, 9, -4};
  const DropResult drop = simulateDrop(box, surface, start, 20);
  ASSERT_GT(drop.steps.size(), 20U);
  const double scale = box.mass * 2;
  int free = 0;
  for (const ContactStep& step : drop.steps) {
    Eigen::Vector3d change = box.mass * (step.after.velocity - step.before.velocity);
    change.z() += box.mass * kGravity * step.duration;
    // A step that had to give up energy lost speed by scaling.
    EXPECT_LT((change - step.impulse).norm(), 1e-4 * scale);
    if (step.duration <= 0 && (change - step.impulse).norm() < 1e-12 * scale) ++free;
  }
  EXPECT_GT(free, 3);
}

}  // namespace
}  // namespace ifa
