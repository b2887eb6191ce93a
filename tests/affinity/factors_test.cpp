// SPDX-License-Identifier: Apache-2.0
// Equations 4 to 13, and what the paper's text says of their half-widths.
#include "affinity/factors.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

namespace ifa {
namespace {

TEST(FactorsTest, OrientationHasAHalfWidthOf0Point9RadPerSecond) {
  EXPECT_NEAR(std::exp(logOrientation(0.9 * 0.1, 0.1)), 0.5, 0.003);
  EXPECT_NEAR(std::exp(logOrientation(0.9 * 0.15, 0.15)), 0.5, 0.003);
  EXPECT_NEAR(logOrientation(0.05, 0.1), -0.85 * 0.25, 1e-12);
}

TEST(FactorsTest, OrientationOfLongFlightsIsLimitedAtT0) {
  // 0.9 rad/s over 0.2 s are about 10 degrees, and no longer flight allows more.
  const double limit = 0.9 * 0.2;
  EXPECT_NEAR(limit * 180 / M_PI, 10, 0.4);
  for (const double time : {0.2, 0.5, 3.0}) {
    EXPECT_NEAR(std::exp(logOrientation(limit, time)), 0.5, 0.003) << time;
  }
}

TEST(FactorsTest, TimeWarpHasAHalfWidthOf8Point3Percent) {
  EXPECT_NEAR(std::exp(logTimeWarp(1.083, 1)), 0.5, 0.003);
  EXPECT_NEAR(std::exp(logTimeWarp(0.3, 0.3 * 1.083)), 0.5, 0.003);
  EXPECT_LT(std::exp(logTimeWarp(1.15, 1)), 0.11);  // "errors beyond 15 % are unlikely"
  EXPECT_EQ(logTimeWarp(0.4, 0.4), 0);
}

TEST(FactorsTest, TimeWarpIsTheSameFasterOrSlower) {
  EXPECT_TRUE(rc::check("f_t(a, b) == f_t(b, a), and only the ratio counts", [] {
    const double a = *rc::gen::inRange(1, 2000) / 1000.0, b = *rc::gen::inRange(1, 2000) / 1000.0;
    const double log = logTimeWarp(a, b);
    RC_ASSERT(log == logTimeWarp(b, a));
    RC_ASSERT(log <= 0);
    RC_ASSERT(std::abs(logTimeWarp(3 * a, 3 * b) - log) <= 1e-9 * (1 - log));
  }));
}

TEST(FactorsTest, AmplitudeHasAHalfWidthOfAHalf) {
  EXPECT_NEAR(std::exp(logAmplitude({1.5, 0, 0}, {1.0, 0, 0})), 0.5, 0.003);
  EXPECT_NEAR(std::exp(logAmplitude({0.2, 0, 0}, {0.7, 0.3, 0.1})), 0.5, 0.003);
  EXPECT_EQ(logAmplitude({0.7, 0, 0}, {0.7, 0, 0}), 0);
}

TEST(FactorsTest, DurationAndCentroidHaveAHalfWidthOf10Milliseconds) {
  const HeardEvent target{1, 0.050, 0.020};
  EXPECT_NEAR(std::exp(logDuration(target, {1, 0.060, 0.020})), 0.5, 0.004);
  EXPECT_NEAR(std::exp(logDuration(target, {1, 0.040, 0.020})), 0.5, 0.004);
  EXPECT_NEAR(std::exp(logCentroid(target, {1, 0.050, 0.030})), 0.5, 0.004);
  EXPECT_NEAR(std::exp(logCentroid(target, {1, 0.050, 0.010})), 0.5, 0.004);
  EXPECT_EQ(logDuration(target, {2, 0.050, 0}), 0);
  EXPECT_EQ(logCentroid(target, {2, 0.090, 0.020}), 0);
}

TEST(FactorsTest, TwoClicksAreNotComparedByDurationOrCentroid) {
  // Centroids of clicks mean nothing, so they are not looked at.
  EXPECT_EQ(logDuration({1, 0, 0.5}, {1, 0, 0.1}), 0);
  EXPECT_EQ(logCentroid({1, 0, 0.5}, {1, 0, 0.1}), 0);
}

TEST(FactorsTest, RattleAgainstClickPays) {
  const HeardEvent click{1, 0, 0.7}, rattle{1, 0.030, 0.012};
  for (const auto& [a, b] : {std::pair{click, rattle}, std::pair{rattle, click}}) {
    EXPECT_NEAR(logDuration(a, b), -7000 * 0.030 * 0.030, 1e-9);
    EXPECT_NEAR(logCentroid(a, b), -7000 * 0.012 * 0.012, 1e-9);
  }
}

TEST(FactorsTest, EnergyMustNotRiseButForTheGainAsked) {
  EXPECT_TRUE(energyAllows(1.0, 0.99, 0));
  EXPECT_TRUE(energyAllows(1.0, 1.0, 0));
  EXPECT_FALSE(energyAllows(1.0, 1.0001, 0));
  EXPECT_TRUE(energyAllows(1.0, 1.19, 0.2));
  EXPECT_FALSE(energyAllows(1.0, 1.21, 0.2));
}

TEST(FactorsTest, ScoresAreTheRootsOfTheProducts) {
  EXPECT_TRUE(rc::check("eq. 12, 13 and the geometric mean of f_v from direct products", [] {
    const int n = *rc::gen::inRange(1, 12);
    const auto log = [] { return -*rc::gen::inRange(0, 3000) / 1000.0; };
    LogScore sums;
    double all = 1, motion = 1, velocity = 1;
    for (int k = 0; k < n; ++k) {
      const double v = log(), q = log(), t = log(), a = log(), l = log(), c = log();
      sums.sound += a + l + c;
      sums.motion += v + q + t;
      sums.velocity += v;
      const double moving = std::exp(v) * std::exp(q) * std::exp(t);
      all *= moving * std::exp(a) * std::exp(l) * std::exp(c);
      motion *= moving;
      velocity *= std::exp(v);
    }
    RC_ASSERT(std::abs(sums.score(n) - std::pow(all, 1.0 / (6 * n))) < 1e-9);
    RC_ASSERT(std::abs(sums.scoreWithoutSound(n) - std::pow(motion, 1.0 / (3 * n))) < 1e-9);
    RC_ASSERT(std::abs(sums.meanVelocity(n) - std::pow(velocity, 1.0 / n)) < 1e-9);
  }));
}

TEST(FactorsTest, FlawlessPathScoresOne) {
  const LogScore none;
  EXPECT_EQ(none.score(5), 1);
  EXPECT_EQ(none.scoreWithoutSound(5), 1);
  EXPECT_EQ(none.meanVelocity(5), 1);
}

}  // namespace
}  // namespace ifa
