// SPDX-License-Identifier: Apache-2.0
#include "planner/energy_outlook.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/energy.h"
#include "dynamics/simulator.h"
#include "planner/bodies.h"

namespace ifa {
namespace {

TEST(EnergyOutlookTest, FeaturesTellOfWhatFollows) {
  const std::vector<double> starts = {0, 0.3, 0.5, 0.55}, impulses = {5, 4, 2, 1};
  const auto first = EnergyOutlook::features(starts, impulses, 0);
  EXPECT_EQ(first[0], 1);
  EXPECT_NEAR(first[1], std::log(0.3), 1e-12);   // next gap
  EXPECT_NEAR(first[2], std::log(0.3), 1e-12);   // largest gap
  EXPECT_NEAR(first[3], std::log(0.55), 1e-12);  // time left
  EXPECT_NEAR(first[4], std::log(7.0), 1e-12);   // impulses left
  EXPECT_NEAR(first[5], std::log(3.0), 1e-12);   // contacts left
  const auto third = EnergyOutlook::features(starts, impulses, 2);
  EXPECT_NEAR(third[1], std::log(0.05), 1e-12);
  EXPECT_NEAR(third[2], std::log(0.05), 1e-12);
  EXPECT_NEAR(third[3], std::log(0.05), 1e-12);
  EXPECT_NEAR(third[4], 0, 1e-12);
  EXPECT_NEAR(third[5], 0, 1e-12);
}

/// Deviations of all events but the last of drops that the outlook was not learnt from.
std::vector<double> deviations(const test::Ground& ground, const BodyModel& model,
                               const EnergyOutlook& outlook, std::uint64_t drops) {
  std::vector<double> all;
  for (std::uint64_t i = 0; i < drops; ++i) {
    const DropResult drop = simulateDrop(model, sampleInitialState(ground.body, 98, i), 10);
    const auto events = eventsOf(drop, audibleCut(ground.body, ground.surface));
    std::vector<double> starts, impulses;
    for (const ContactEvent& event : events) {
      starts.push_back(event.start);
      impulses.push_back(event.amplitude);
    }
    for (std::size_t k = 0; k + 1 < events.size(); ++k) {
      all.push_back(outlook.deviation(totalEnergy(model, events[k].after),
                                      EnergyOutlook::features(starts, impulses, k)));
    }
  }
  return all;
}

TEST(EnergyOutlookTest, FreshDropsDeviateByOneStandardDeviation) {
  const test::Ground ground = test::onGround(makeDieBody(), 0.75);
  const BodyModel model(ground.body, ground.surface);
  const auto outlook =
      EnergyOutlook::learn(ground.body, model, audibleCut(ground.body, ground.surface), 600);
  const auto all = deviations(ground, model, outlook, 600);
  ASSERT_GT(all.size(), 1000U);
  double mean = 0, squares = 0;
  for (const double deviation : all) {
    mean += deviation / static_cast<double>(all.size());
    squares += deviation * deviation / static_cast<double>(all.size());
  }
  EXPECT_NEAR(mean, 0, 0.1);
  EXPECT_NEAR(std::sqrt(squares), 1, 0.15);
  // A die rests on a face, 8 mm under its centre.
  EXPECT_NEAR(outlook.restEnergy(), ground.body.mass * kGravity * 0.008, 2e-6);
}

TEST(EnergyOutlookTest, MoreEnergyDeviatesMore) {
  const test::Ground ground = test::onGround(makeDieBody(), 0.75);
  const BodyModel model(ground.body, ground.surface);
  const auto outlook =
      EnergyOutlook::learn(ground.body, model, audibleCut(ground.body, ground.surface), 200);
  const auto features = EnergyOutlook::features({0, 0.2, 0.35}, {0.02, 0.015, 0.01}, 0);
  const double rest = outlook.restEnergy();
  double last = -1e9;
  for (const double above : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    const double deviation = outlook.deviation(rest * (1 + above), features);
    EXPECT_GT(deviation, last);
    last = deviation;
  }
  EXPECT_GT(last, 2);  // enough for a fall from 0.8 m
  EXPECT_TRUE(std::isfinite(outlook.deviation(0.5 * rest, features)));
}

TEST(EnergyOutlookTest, LearnsTheSameEachTime) {
  const test::Ground ground = test::onGround(makeDieBody(), 0.75);
  const BodyModel model(ground.body, ground.surface);
  const auto settings = audibleCut(ground.body, ground.surface);
  const auto features = EnergyOutlook::features({0, 0.2, 0.35}, {0.02, 0.015, 0.01}, 1);
  EXPECT_EQ(EnergyOutlook::learn(ground.body, model, settings, 100).deviation(0.01, features),
            EnergyOutlook::learn(ground.body, model, settings, 100).deviation(0.01, features));
}

TEST(EnergyOutlookTest, NothingLearntSaysNothing) {
  const EnergyOutlook outlook;
  EXPECT_EQ(outlook.deviation(1, EnergyOutlook::features({0, 1}, {1, 1}, 0)), 0);
}

}  // namespace
}  // namespace ifa
