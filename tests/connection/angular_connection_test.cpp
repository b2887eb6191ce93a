// SPDX-License-Identifier: Apache-2.0
// Shooting for the spin, against integration by Runge and Kutta.
#include "connection/angular_connection.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "connection/connection_cases.h"
#include "connection/free_turn.h"
#include "connection/rotation_vector.h"

namespace ifa {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using test::integrated;
using test::randomState;
using test::randomVector;

std::vector<Body> bodies() {
  return {makeDieBody(), makePrismBody(6, 0.02, 0.05, 0.1), test::makeTumbler(),
          makeBoxBody({0.06, 0.022, 0.012}, 0.02)};
}

TEST(RotationVector, IsTheInverseOfTurning) {
  RandomStream random(1, 2);
  for (int i = 0; i < 2000; ++i) {
    const double size = i % 2 ? 1.8 : std::pow(10, random.uniform(-12, 0));
    const Vector3d v = randomVector(random, size);
    if (v.norm() > 3.14) continue;
    const Quat<double> q = turnBy<double>({v.x(), v.y(), v.z()});
    const double sign = i % 4 < 2 ? 1 : -1;
    const Vec<double> back = rotationVector(q * sign);
    EXPECT_LT((Vector3d(back.x, back.y, back.z) - v).norm(), 4e-15 * (1 + v.norm()));
  }
}

TEST(RotationVector, PortableAngleIsTheLibrarys) {
  for (int i = 0; i <= 1000; ++i) {
    const double a = i * 1.5707963267948966 / 1000;
    EXPECT_NEAR(portableAngle(std::sin(a), std::cos(a)), a, 4e-16) << i;
  }
}

Vector3d smallTurn(const Quat<double>& from, const Quat<double>& to) {
  const Vec<double> v = rotationVector(Quat<double>{from.w, -from.x, -from.y, -from.z} * to);
  return {v.x, v.y, v.z};
}

TEST(FreeTurn, SlopeIsThatOfDifferences) {
  RandomStream random(3, 4);
  for (const Body& body : bodies()) {
    const BodyModel model(body, {});
    for (int i = 0; i < 50; ++i) {
      const KernelState<double> s = kernelState(randomState(random), 0);
      const double duration = random.uniform(0.01, 0.4);
      const FreeTurn turn = freeTurnWithSlope(model, {s.q, s.w}, duration);
      constexpr double kStep = 1e-4;
      const Vec<double> axes[] = {{kStep, 0, 0}, {0, kStep, 0}, {0, 0, kStep}};
      for (int c = 0; c < 3; ++c) {
        const Vector3d more =
            smallTurn(turn.end.q, freeTurn(model, {s.q, s.w + axes[c]}, duration).end.q);
        const Vector3d less =
            smallTurn(turn.end.q, freeTurn(model, {s.q, s.w - axes[c]}, duration).end.q);
        EXPECT_LT(((more - less) / (2 * kStep) - turn.slope.col(c)).norm(),
                  1e-5 * (turn.slope.norm() + duration));
      }
    }
  }
}

/// The spin that was integrated must come out, from a guess that is 2 % or so off.
TEST(AngularConnection, FindsTheSpinThatWasIntegrated) {
  RandomStream random(5, 6);
  for (const Body& body : bodies()) {
    const BodyModel model(body, {});
    int found = 0, steps = 0;
    constexpr int kCases = 200;
    for (int i = 0; i < kCases; ++i) {
      const RigidState start = randomState(random);
      const double duration = random.uniform(0.02, 0.3);
      const RigidState end = integrated(body, start, duration);
      const Vector3d guess = start.angularVelocity + randomVector(random, 0.1 / duration);
      const AngularConnection c =
          angularConnection(model, start.orientation, end.orientation, duration, guess);
      steps += c.steps;
      ASSERT_TRUE(c.converged) << body.definition.name << i;
      EXPECT_LE(c.missed, 1e-10);
      RigidState flight = start;
      flight.angularVelocity = c.angularVelocity;
      const RigidState landed = integrated(body, flight, duration);
      EXPECT_LT(test::angleBetween(landed.orientation, end.orientation), 1e-7);
      EXPECT_LT((landed.angularVelocity - c.atEnd).norm(), 1e-5);
      found += (c.angularVelocity - start.angularVelocity).norm() < 1e-4;
    }
    std::printf("%s: %d of %d spins found again, %.1f steps\n", body.definition.name.c_str(), found,
                kCases, static_cast<double>(steps) / kCases);
    EXPECT_GT(found, kCases * 0.95);
  }
}

/// How shooting goes for other orientations at the end, up to some 20 degrees off, of a body that
/// tumbles at up to 100 rad/s. Returns the share that converges.
double shareConverged(const ShootingSettings& settings, const char* name) {
  RandomStream random(7, 8);
  const BodyModel model(test::makeTumbler(), {});
  constexpr int kCases = 2000;
  int made = 0, steps = 0;
  for (int i = 0; i < kCases; ++i) {
    const RigidState start = randomState(random);
    const double duration = random.uniform(0.03, 0.3);
    const KernelState<double> s = kernelState(start, 0);
    const Spin<double> end = freeTurn(model, {s.q, s.w}, duration).end;
    const Vector3d off = randomVector(random, 0.2);
    const Quat<double> q = end.q * turnBy<double>({off.x(), off.y(), off.z()});
    const AngularConnection c =
        angularConnection(model, start.orientation, Quaterniond(q.w, q.x, q.y, q.z), duration,
                          start.angularVelocity, settings);
    made += c.converged;
    steps += c.converged ? c.steps : 0;
  }
  std::printf("%s: %.1f %% converged, %.1f steps mean\n", name, 100.0 * made / kCases,
              static_cast<double>(steps) / made);
  return static_cast<double>(made) / kCases;
}

TEST(AngularConnection, ConvergesForNeighboursOfFastTumblers) {
  ShootingSettings settings, wide, printed;
  settings.largestTurn = 0.1745329252;
  printed.step = ShootingStep::kSquaredAngle;
  printed.tolerance = 1e-6;
  EXPECT_GT(shareConverged(settings, "10 degrees"), 0.85);
  EXPECT_GT(shareConverged(wide, "30 degrees"), 0.9);
  EXPECT_GT(shareConverged(printed, "printed"), 0.15);
}

/// As printed: the error of the squared angle halves at each step.
TEST(AngularConnection, PrintedStepHalvesTheError) {
  RandomStream random(9, 10);
  ShootingSettings printed;
  printed.step = ShootingStep::kSquaredAngle;
  printed.tolerance = 1e-6;
  for (const Body& body : bodies()) {
    const BodyModel model(body, {});
    int made = 0;
    for (int i = 0; i < 100; ++i) {
      RigidState start = randomState(random);
      start.angularVelocity *= 0.15;
      const double duration = random.uniform(0.05, 0.2);
      const RigidState end = integrated(body, start, duration);
      const Vector3d guess = start.angularVelocity + randomVector(random, 0.05 / duration);
      const AngularConnection c =
          angularConnection(model, start.orientation, end.orientation, duration, guess, printed);
      made += c.converged;
      if (!c.converged) continue;
      EXPECT_GE(c.steps, 12);
      EXPECT_LE(c.missed, 1e-6);
    }
    EXPECT_GT(made, 90);
  }
}

TEST(AngularConnection, MeanMomentumOfOneFlightIsItsOwn) {
  RandomStream random(11, 12);
  const Body body = test::makeTumbler();
  const BodyModel model(body, {});
  const RigidState start = randomState(random), end = integrated(body, start, 0.2);
  const Vector3d mean = meanMomentumSpin(model, start.orientation, start.angularVelocity,
                                         end.orientation, end.angularVelocity);
  EXPECT_LT((mean - start.angularVelocity).norm(), 1e-5);
}

}  // namespace
}  // namespace ifa
