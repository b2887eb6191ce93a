// SPDX-License-Identifier: Apache-2.0
#include "sampler/initial_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "support/box_body.h"

namespace ifa {
namespace {

constexpr std::uint64_t kSeed = 11;
constexpr std::size_t kCount = 20000;
/// Kolmogorov-Smirnov distance that a right sampler exceeds once in 10,000 runs.
const double kCritical = 2.23 / std::sqrt(static_cast<double>(kCount));

/// Largest distance of the samples' distribution from uniform on [0, 1].
double distanceFromUniform(const std::function<double(const RigidState&)>& quantile,
                           const Body& body) {
  std::vector<double> values(kCount);
  for (std::size_t i = 0; i < kCount; ++i) values[i] = quantile(sampleInitialState(body, kSeed, i));
  std::sort(values.begin(), values.end());
  double distance = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double share = static_cast<double>(i) / kCount;
    distance = std::max({distance, std::abs(values[i] - share), values[i] - share - 1.0 / kCount});
  }
  return distance;
}

Body tiltedBox() {
  Body box = makeBoxBody({0.05, 0.03, 0.01}, 0.02);
  box.bodyFromPrincipal =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return box;
}

TEST(InitialState, LowestHullVertexTouchesTheGround) {
  const Body box = tiltedBox();
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const RigidState state = sampleInitialState(box, kSeed, i);
    double lowest = 1;
    for (const Eigen::Vector3d& v : box.hull) {
      const Eigen::Vector3d inPrincipal = box.bodyFromPrincipal.transpose() * v;
      lowest = std::min(lowest, (state.position + state.orientation * inPrincipal).z());
    }
    EXPECT_NEAR(lowest, 0, 1e-12);
    EXPECT_EQ(state.position.x(), 0);
    EXPECT_EQ(state.position.y(), 0);
    EXPECT_NEAR(state.orientation.norm(), 1, 1e-12);
  }
}

TEST(InitialState, SpeedIsUniformInItsRange) {
  const Body die = makeDieBody();
  EXPECT_LT(distanceFromUniform([](const auto& s) { return (s.velocity.norm() - 0.5) / 3.5; }, die),
            kCritical);
}

TEST(InitialState, DirectionIsCosineWeightedWithinTheCone) {
  for (const double cone : {30.0, 80.0, 90.0}) {
    Body die = makeDieBody();
    die.definition.sampling.coneDegrees = cone;
    const double largest = std::pow(std::sin(cone * 3.14159265358979 / 180), 2);
    const auto quantile = [&](const RigidState& s) {
      EXPECT_LE(s.velocity.z(), 0);
      const Eigen::Vector3d d = s.velocity.normalized();
      return (d.x() * d.x() + d.y() * d.y()) / largest;
    };
    EXPECT_LT(distanceFromUniform(quantile, die), kCritical) << cone;
  }
}

TEST(InitialState, AzimuthIsUniform) {
  const Body die = makeDieBody();
  EXPECT_LT(distanceFromUniform(
                [](const auto& s) {
                  return std::atan2(s.velocity.y(), s.velocity.x()) / 6.28318530717959 + 0.5;
                },
                die),
            kCritical);
}

TEST(InitialState, SpinIsUniformInMagnitudeAndDirection) {
  const Body die = makeDieBody();
  EXPECT_LT(distanceFromUniform([](const auto& s) { return s.angularVelocity.norm() / 20; }, die),
            kCritical);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(
        distanceFromUniform(
            [&](const auto& s) { return s.angularVelocity.normalized()[axis] / 2 + 0.5; }, die),
        kCritical);
  }
}

TEST(InitialState, OrientationIsUniformOverRotations) {
  const Body die = makeDieBody();
  // Of a uniform rotation, every body axis is uniform on the sphere: each coordinate is uniform.
  for (int axis = 0; axis < 3; ++axis) {
    const auto height = [&](const RigidState& s) {
      return (s.orientation * Eigen::Vector3d::Unit(axis)).z() / 2 + 0.5;
    };
    EXPECT_LT(distanceFromUniform(height, die), kCritical);
  }
  // ... and the angle has the density (1 - cos a) / pi.
  const auto angle = [](const RigidState& s) {
    const double a = 2 * std::acos(std::min(1.0, std::abs(s.orientation.w())));
    return (a - std::sin(a)) / 3.14159265358979;
  };
  EXPECT_LT(distanceFromUniform(angle, die), kCritical);
}

TEST(InitialState, DependsOnSeedAndIndexOnly) {
  const Body die = makeDieBody();
  const RigidState a = sampleInitialState(die, 5, 7);
  static_cast<void>(sampleInitialState(die, 5, 8));
  const RigidState b = sampleInitialState(die, 5, 7);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
  EXPECT_NE(a.velocity, sampleInitialState(die, 5, 8).velocity);
  EXPECT_NE(a.velocity, sampleInitialState(die, 6, 7).velocity);
}

TEST(InitialState, BitsAreTheSameEverywhere) {
  const RigidState s = sampleInitialState(makeDieBody(), 1, 2);
  EXPECT_EQ(s.position.z(), 0x1.494ba8a44eb7ep-7);
  EXPECT_EQ(s.velocity.x(), 0x1.d56df625f7fb5p-2);
  EXPECT_EQ(s.velocity.z(), -0x1.c06221227ec21p+0);
  EXPECT_EQ(s.orientation.w(), 0x1.9db8ba7ce68p-4);
  EXPECT_EQ(s.angularVelocity.y(), -0x1.10afcf2766e2ap-2);
}

}  // namespace
}  // namespace ifa
