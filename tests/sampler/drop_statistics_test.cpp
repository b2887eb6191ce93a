// SPDX-License-Identifier: Apache-2.0
#include "sampler/drop_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/parallel.h"
#include "dynamics/simulator.h"
#include "sampler/initial_state.h"
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

/// The resting contact is clipped, however long a simulator waits to be sure of it.
TEST(DropStatistics, ThePapersCutEndsWhereTheBodyRests) {
  const Body die = makeDieBody();
  DropResult drop;
  drop.steps = {stepAt(0, 1, 0.02)};
  for (int i = 0; i < 40; ++i) {
    drop.steps.push_back(stepAt(0.5 + i * 1e-3, 0.01, 1e-5));
    drop.steps.back().duration = 1e-3;
  }
  drop.restTime = 0.510;
  const auto ends = [&](bool atRest) {
    drop.atRest = atRest;
    const auto events = eventsOf(drop, recorderFor(EventCut::kPaper, die, {}));
    EXPECT_EQ(events.size(), 2U);
    EXPECT_EQ(events.back().terminal, atRest);
    return events.back().end;
  };
  EXPECT_NEAR(ends(true), 0.510, 1e-9);
  EXPECT_NEAR(ends(false), 0.540, 1e-9);
}

/// What is heard lies within contacts by the paper's cut.
TEST(DropStatistics, ThePapersCutHoldsTheAudibleOne) {
  const Body die = makeDieBody();
  SurfaceProperties surface;
  surface.restitution = 0.6;
  surface.referenceImpulse = 0.0147;
  std::size_t audible = 0, paper = 0;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const DropResult drop = simulateDrop(die, surface, sampleInitialState(die, 3, i), 20);
    const auto outer = eventsOf(drop, recorderFor(EventCut::kPaper, die, surface));
    for (const auto& inner : eventsOf(drop, recorderFor(EventCut::kAudible, die, surface))) {
      EXPECT_TRUE(std::any_of(outer.begin(), outer.end(), [&](const ContactEvent& event) {
        return event.start <= inner.start + 1e-9 && event.end >= inner.end - 1e-9;
      }));
      ++audible;
    }
    paper += outer.size();
    EXPECT_NEAR(outer.back().end, drop.restTime, 1e-9);
  }
  EXPECT_NE(paper, audible);
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
