// SPDX-License-Identifier: Apache-2.0
// Equations 2 and 3: the region of velocities that still look plausible after a contact.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <cmath>

#include "affinity/factors.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kRadius = 0.01;

Vector3d anyVector(double length) {
  const auto part = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const Vector3d v(part(), part(), part());
  return v * length;
}

TEST(PlausibleRegionTest, HalfAxesAreThosePrinted) {
  // Contact turns (1, 0, -2) into (1, 0, 1.5) m/s, and the spin changes by (0, 20, 0) rad/s.
  const PlausibleRegion region(Vector3d(0, 0, 3.5), Vector3d(0, 20, 0), kRadius);
  // a = 0.4 x 3.5, b = a tan 20 degrees; c = 0.2 x 20, d = c tan 10 degrees.
  EXPECT_NEAR(region.bend({0, 0, 1.4}, Vector3d::Zero()), 1, 1e-12);
  EXPECT_NEAR(region.bend({0, 0, -1.4}, Vector3d::Zero()), 1, 1e-12);
  EXPECT_NEAR(region.bend({0.509558, 0, 0}, Vector3d::Zero()), 1, 1e-6);
  EXPECT_NEAR(region.bend({0, 0.509558, 0}, Vector3d::Zero()), 1, 1e-6);
  EXPECT_NEAR(region.bend(Vector3d::Zero(), {0, 4, 0}), 1, 1e-12);
  EXPECT_NEAR(region.bend(Vector3d::Zero(), {0.705308, 0, 0}), 1, 1e-6);
  EXPECT_NEAR(region.bend(Vector3d::Zero(), {0, 0, 0.705308}), 1, 1e-6);
}

TEST(PlausibleRegionTest, HalfAxesFollowAnObliqueChange) {
  // (3, 4, 12) is 13 long: a = 5.2 along it, b = 1.892645 across.
  const PlausibleRegion region(Vector3d(3, 4, 12), Vector3d(0, 0, 1), kRadius);
  EXPECT_NEAR(region.bend(Vector3d(3, 4, 12) * (5.2 / 13), Vector3d::Zero()), 1, 1e-12);
  EXPECT_NEAR(region.bend(Vector3d(4, -3, 0) * (1.892645 / 5), Vector3d::Zero()), 1, 1e-6);
  EXPECT_NEAR(region.bend(Vector3d(36, 48, -25) * (1.892645 / 65), Vector3d::Zero()), 1, 1e-6);
}

TEST(PlausibleRegionTest, BendIsTheLengthInAllSixDimensions) {
  const PlausibleRegion region(Vector3d(0, 0, 1), Vector3d(10, 0, 0), kRadius);
  // Half the region along the linear change (0.4), half of it along the angular one (2).
  EXPECT_NEAR(region.bend({0, 0, 0.2}, {1, 0, 0}), std::sqrt(0.5), 1e-12);
  EXPECT_EQ(region.bend(Vector3d::Zero(), Vector3d::Zero()), 0);
}

TEST(PlausibleRegionTest, VelocityFactorIsHalfAtSquaredBendOf069) {
  EXPECT_NEAR(std::exp(logVelocity(std::sqrt(0.69))), 0.5, 0.002);
  EXPECT_NEAR(std::exp(logVelocity(1)), 0.3679, 1e-4);
  EXPECT_EQ(logVelocity(0), 0);
}

TEST(PlausibleRegionTest, ChangeAndCoordinatesAreInverse) {
  EXPECT_TRUE(rc::check("coordinates(change(y)) == y and bend == |y|", [] {
    const Vector3d linear = anyVector(5), angular = anyVector(60);
    const PlausibleRegion region(linear, angular, kRadius);
    Vector6d y;
    y << anyVector(2), anyVector(2);
    Vector3d v, w;
    region.change(y, v, w);
    const double small = 1e-9 * (1 + y.norm());
    RC_ASSERT((region.coordinates(v, w) - y).norm() < small);
    RC_ASSERT(std::abs(region.bend(v, w) - y.norm()) < small);
  }));
}

TEST(PlausibleRegionTest, TurnsWithTheContact) {
  EXPECT_TRUE(rc::check("the same bend in every direction", [] {
    const Vector3d linear = anyVector(5), angular = anyVector(60);
    const Vector3d v = anyVector(1), w = anyVector(9);
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(*rc::gen::inRange(-300, 300) / 100.0, Vector3d::UnitX()) *
         Eigen::AngleAxisd(*rc::gen::inRange(-300, 300) / 100.0, Vector3d::UnitZ()))
            .toRotationMatrix();
    // At exactly no change of velocity the region has no direction of its own.
    RC_PRE(linear.norm() > 0 && angular.norm() > 0);
    const double bend = PlausibleRegion(linear, angular, kRadius).bend(v, w);
    const double turned =
        PlausibleRegion(turn * linear, turn * angular, kRadius).bend(turn * v, turn * w);
    RC_ASSERT(std::abs(bend - turned) < 1e-9 * (1 + bend));
  }));
}

TEST(PlausibleRegionTest, ChangeIsLinear) {
  const PlausibleRegion region(Vector3d(1, 2, 3), Vector3d(-4, 5, 6), kRadius);
  Vector6d y;
  y << 0.3, -0.2, 0.1, 0.5, 0.4, -0.6;
  Vector3d v, w, v2, w2;
  region.change(y, v, w);
  region.change(2 * y, v2, w2);
  EXPECT_LT((2 * v - v2).norm() + (2 * w - w2).norm(), 1e-12);
  EXPECT_LT((region.linearAxes() * y.head<3>() - v).norm(), 1e-15);
  EXPECT_LT((region.angularAxes() * y.tail<3>() - w).norm(), 1e-15);
}

TEST(PlausibleRegionTest, ContactThatChangesNothingLeavesTheFloor) {
  const PlausibleRegion region(Vector3d::Zero(), Vector3d::Zero(), kRadius);
  // 0.05 m/s and, at a radius of 10 mm, 5 rad/s, in whatever direction: straight up is chosen.
  EXPECT_NEAR(region.bend({0, 0, 0.4 * 0.05}, Vector3d::Zero()), 1, 1e-12);
  EXPECT_NEAR(region.bend(Vector3d::Zero(), {0, 0, 0.2 * 5}), 1, 1e-12);
  EXPECT_TRUE(std::isfinite(region.bend({1, 2, 3}, {4, 5, 6})));
}

TEST(PlausibleRegionTest, FloorIsReachedWithoutAJump) {
  for (const double length : {0.0499999, 0.0500001}) {
    const PlausibleRegion region(Vector3d(length, 0, 0), Vector3d(0, length / kRadius, 0), kRadius);
    EXPECT_NEAR(region.bend({0.02, 0, 0}, Vector3d::Zero()), 1, 1e-5) << length;
    EXPECT_NEAR(region.bend(Vector3d::Zero(), {0, 1, 0}), 1, 1e-5) << length;
  }
  // Under the floor the direction of the contact still counts.
  const PlausibleRegion region(Vector3d(1e-6, 0, 0), Vector3d(0, 1e-6, 0), kRadius);
  EXPECT_NEAR(region.bend({0.02, 0, 0}, Vector3d::Zero()), 1, 1e-9);
  EXPECT_NEAR(region.bend({0, 0, 0.02}, Vector3d::Zero()), 1 / 0.36397, 1e-4);
}

}  // namespace
}  // namespace ifa
