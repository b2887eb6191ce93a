// SPDX-License-Identifier: Apache-2.0
// Torque-free rotation against its closed form and a fine integration; first touches against
// sampling.
#include "dynamics/flight.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kernel_drops.h"
#include "support/box_body.h"

namespace ifa {
namespace {

RigidState spinning(const Eigen::Vector3d& spin) {
  RigidState state;
  state.position.z() = 100;
  state.orientation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized());
  state.angularVelocity = spin;
  return state;
}

KernelState<double> flown(const BodyModel& model, const RigidState& start, double time) {
  KernelState<double> state = kernelState(start, 0);
  while (state.time < time) {
    const FlightSegment segment(model, state, time - state.time);
    state = segment.at(segment.length());
  }
  return state;
}

double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return 2 * (a.conjugate() * b).vec().norm();
}

/// Euler's equations and q' = q w / 2 by classical Runge-Kutta; `y` is q (w, x, y, z), then w.
using Rotating = Eigen::Matrix<double, 7, 1>;

Rotating slopeOf(const Rotating& y, const Eigen::Vector3d& inertia) {
  const Eigen::Quaterniond q(y[0], y[1], y[2], y[3]);
  const Eigen::Vector3d w = y.tail<3>();
  const Eigen::Quaterniond turn = q * Eigen::Quaterniond(0, w.x(), w.y(), w.z());
  Rotating slope;
  slope << turn.w() / 2, turn.x() / 2, turn.y() / 2, turn.z() / 2,
      -w.cross(inertia.cwiseProduct(w)).cwiseQuotient(inertia);
  return slope;
}

Rotating integrated(Rotating y, const Eigen::Vector3d& inertia, double time, int steps) {
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Rotating a = slopeOf(y, inertia), b = slopeOf(y + h / 2 * a, inertia),
                   c = slopeOf(y + h / 2 * b, inertia), d = slopeOf(y + h * c, inertia);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y;
}

TEST(Flight, SymmetricTopPrecessesByTheBook) {
  const Body prism = makePrismBody(6, 0.02, 0.05, 0.1);
  const BodyModel model(prism, {});
  ASSERT_GE(model.symmetryAxis, 0);
  const RigidState start = spinning({11, -6, 9});
  const Eigen::Vector3d own = start.orientation.conjugate() * start.angularVelocity;
  const Eigen::Vector3d momentum = start.orientation * prism.principalMoments.cwiseProduct(own);
  // A turn about the angular momentum after one about the axis, both at even rates.
  const double across = prism.principalMoments.y(), along = prism.principalMoments.x();
  for (const double time : {0.01, 0.3, 2.0}) {
    const double precession = momentum.norm() / across;
    const double relative = own.x() * (1 - along / across);
    const Eigen::Quaterniond expected =
        Eigen::AngleAxisd(precession * time, momentum.normalized()) * start.orientation *
        Eigen::AngleAxisd(relative * time, Eigen::Vector3d::UnitX());
    const RigidState end = rigidState(flown(model, start, time));
    EXPECT_LT(angleBetween(end.orientation, expected), 1e-9) << time;
  }
}

TEST(Flight, AsymmetricBodyTumblesAsIntegrated) {
  const Body box = makeBoxBody({0.06, 0.02, 0.011}, 0.02);
  const BodyModel model(box, {});
  ASSERT_FALSE(closedForm(model));
  const RigidState start = spinning({3, 17, -2});
  const Eigen::Vector3d w = start.orientation.conjugate() * start.angularVelocity;
  Rotating y;
  y << start.orientation.w(), start.orientation.vec(), w;
  constexpr double kTime = 1;
  const Rotating end = integrated(y, box.principalMoments, kTime, 20000);
  const KernelState<double> state = flown(model, start, kTime);
  const Eigen::Quaterniond expected =
      Eigen::Quaterniond(end[0], end[1], end[2], end[3]).normalized();
  EXPECT_LT(angleBetween(rigidState(state).orientation, expected), 1e-7);
  EXPECT_NEAR(state.w.x, end[4], 1e-6);
  EXPECT_NEAR(state.w.y, end[5], 1e-6);
  EXPECT_NEAR(state.w.z, end[6], 1e-6);
}

TEST(Flight, AngularMomentumAndEnergyStay) {
  for (const Body& body :
       {makeDieBody(), makePrismBody(6, 0.02, 0.05, 0.1), makeBoxBody({0.06, 0.02, 0.011}, 0.02)}) {
    const BodyModel model(body, {});
    const RigidState start = spinning({13, -8, 5});
    const auto momentumOf = [&](const KernelState<double>& s) {
      return angularMomentum(model, Rotation<double>(s.q), s.w);
    };
    const KernelState<double> first = kernelState(start, 0), end = flown(model, start, 1);
    const Vec<double> before = momentumOf(first), change = momentumOf(end) - before;
    EXPECT_LT(std::sqrt(dot(change, change) / dot(before, before)), 1e-9);
    EXPECT_NEAR(totalEnergy(model, end) / totalEnergy(model, first), 1, 1e-10);
  }
}

/// First time at which the lowest of all vertices is at the ground, by small steps and bisection.
double touchBySampling(const BodyModel& model, const RigidState& start) {
  constexpr double kStep = 1e-4;
  double time = 0;
  while (lowestVertex(model, flown(model, start, time + kStep)) > 0) time += kStep;
  double low = time, high = time + kStep;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (lowestVertex(model, flown(model, start, middle)) > 0 ? low : high) = middle;
  }
  return low;
}

TEST(Flight, FirstTouchIsWhatSamplingFinds) {
  for (const Body& body : {makeDieBody(), makePrismBody(24, 0.03, 0.05, 0.1),
                           makeBoxBody({0.06, 0.02, 0.011}, 0.02)}) {
    const BodyModel model(body, {});
    for (int i = 0; i < 12; ++i) {
      RigidState start = spinning({3.0 + 2 * i, 10.0 - 3 * i, 5.0 - i});
      start.position.z() = body.radius * 1.1 + 0.004 * i;
      start.velocity = {0.3, 0, 0.5 - 0.1 * i};
      KernelState<double> state = kernelState(start, 0);
      double hit = 2;
      while (hit > 1) {
        const FlightSegment segment(model, state, 10);
        hit = segment.firstTouch() <= segment.length() ? 0 : 2;
        state = segment.at(hit > 1 ? segment.length() : segment.firstTouch());
      }
      EXPECT_NEAR(state.time, touchBySampling(model, start), 1e-6) << i;
      EXPECT_NEAR(lowestVertex(model, state), 0, model.hitGap) << i;
    }
  }
}

}  // namespace
}  // namespace ifa
