// SPDX-License-Identifier: Apache-2.0
#include "sampler/drop_statistics.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/box_body.h"

namespace ifa {
namespace {

TEST(DropStatistics, DistributionDistanceIsTheLargestGapBetweenStaircases) {
  EXPECT_DOUBLE_EQ(distributionDistance({1, 2, 3, 4}, {1, 2, 3, 4}), 0);
  EXPECT_DOUBLE_EQ(distributionDistance({1, 2}, {3, 4}), 1);
  EXPECT_DOUBLE_EQ(distributionDistance({1, 2, 3, 4}, {3, 4, 5, 6}), 0.5);
  EXPECT_DOUBLE_EQ(distributionDistance({1, 1, 1, 2}, {1, 2, 2, 2}), 0.5);
  EXPECT_DOUBLE_EQ(distributionDistance({1}, {1, 1, 1}), 0);
  EXPECT_DOUBLE_EQ(distributionDistance({}, {1}), 1);
  EXPECT_DOUBLE_EQ(distributionDistance({}, {}), 0);
}

TEST(DropStatistics, MeanAndMedian) {
  EXPECT_DOUBLE_EQ(mean({1, 2, 6}), 3);
  EXPECT_DOUBLE_EQ(mean({}), 0);
  EXPECT_DOUBLE_EQ(median({5, 1, 3}), 3);
  EXPECT_DOUBLE_EQ(median({4, 1, 3, 2}), 3);
  EXPECT_DOUBLE_EQ(median({}), 0);
}

TEST(DropStatistics, KineticSpeedCountsTranslationAndSpin) {
  const Body box = makeBoxBody({0.04, 0.02, 0.01}, 0.03);
  RigidState state;
  state.orientation = Eigen::AngleAxisd(1.57079632679489662, Eigen::Vector3d::UnitZ());
  state.velocity = {3, 0, 0};
  state.angularVelocity = {0, 10, 0};  // about the box's x axis, turned
  const double expected = std::sqrt(9 + box.principalMoments.x() * 100 / box.mass);
  EXPECT_NEAR(kineticSpeed(box, state), expected, 1e-12);
}

ContactStep stepAt(double time, double speed, double impulse) {
  ContactStep step;
  step.time = time;
  step.before.velocity.z() = -speed;
  step.impulse.z() = impulse;
  return step;
}

TEST(DropStatistics, TimeToRestIsTheEndOfTheLastFastContact) {
  const Body die = makeDieBody();
  std::vector<ContactStep> steps = {stepAt(0, 2, 1), stepAt(0.4, 0.06, 1), stepAt(0.5, 0.04, 1)};
  steps[1].duration = 0.001;
  EXPECT_DOUBLE_EQ(timeToRest(die, steps), 0.401);
  EXPECT_DOUBLE_EQ(timeToRest(die, steps, 0.03), 0.5);
  EXPECT_DOUBLE_EQ(timeToRest(die, {}), 0);
}

TEST(DropStatistics, GathersTheSameOnAnyNumberOfThreads) {
  const Body die = makeDieBody();
  SurfaceProperties surface;
  surface.referenceImpulse = 0.01;
  const auto simulate = [](const RigidState& start) {
    DropResult drop;
    drop.atRest = start.velocity.z() < -1;
    drop.steps = {stepAt(0, 1, 0.02), stepAt(0.1, 1, 0.01), stepAt(0.15, 1, 5e-5)};
    drop.steps[1].impulse.z() *= -start.velocity.z();
    return drop;
  };
  setThreadCount(1);
  const DropStatistics one = gatherStatistics(die, surface, simulate, 3, 200);
  setThreadCount(0);
  const DropStatistics many = gatherStatistics(die, surface, simulate, 3, 200);
  EXPECT_EQ(one.largestImpulse, many.largestImpulse);
  EXPECT_EQ(one.unfinished, many.unfinished);
  EXPECT_GT(one.unfinished, 0U);
  EXPECT_LT(one.unfinished, 200U);
  // The third contact is under the threshold of hearing, but the paper's cut counts it.
  EXPECT_DOUBLE_EQ(mean(one.paperEvents), 3);
  EXPECT_DOUBLE_EQ(mean(one.audibleEvents), 2);
  ASSERT_EQ(one.gaps.size(), 200U);
  EXPECT_DOUBLE_EQ(one.gaps[0], 0.1);
}

}  // namespace
}  // namespace ifa
