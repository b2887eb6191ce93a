// SPDX-License-Identifier: Apache-2.0
#include "planner/restitution_outlook.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "planner/shooting_cases.h"

namespace ifa {
namespace {

constexpr int kDrops = 400;

RestitutionOutlook learn() {
  const Body& die = test::die();
  const SurfaceProperties& surface = die.definition.surfaces.at("desk");
  return RestitutionOutlook::learn(die, surface, audibleCut(die, surface), kDrops);
}

/// Mean of what 40 drops of that restitution sound like.
double meanEstimate(const RestitutionOutlook& outlook, double restitution) {
  Body body = test::die();
  body.definition.surfaces.at("desk").restitution = restitution;
  double sum = 0;
  constexpr int kCount = 40;
  for (const ContactSignature& signature : test::signatures(body, kCount, 2, 1000)) {
    sum += outlook.estimate(signature);
  }
  return sum / kCount;
}

TEST(RestitutionOutlookTest, HearsTheRestitutionOfDropsItHasNotSeen) {
  const RestitutionOutlook outlook = learn();
  for (const double restitution : {0.6, 0.7, 0.8, 0.9}) {
    EXPECT_NEAR(meanEstimate(outlook, restitution), restitution, 0.05);
  }
  EXPECT_LT(outlook.spread(), 0.1);
}

TEST(RestitutionOutlookTest, ComesBackFromItsCoefficients) {
  const RestitutionOutlook outlook = learn(), again(outlook.coefficients());
  const ContactSignature rhythm = test::signatureOfDrop(test::die(), 3);
  EXPECT_EQ(outlook.estimate(rhythm), again.estimate(rhythm));
  EXPECT_EQ(outlook.spread(), again.spread());
}

TEST(RestitutionOutlookTest, TheSameForAnyNumberOfThreads) {
  setThreadCount(1);
  const auto one = learn().coefficients();
  setThreadCount(2);
  const auto two = learn().coefficients();
  setThreadCount(0);
  EXPECT_EQ(one.weights, two.weights);
  EXPECT_EQ(one.spread, two.spread);
}

TEST(RestitutionOutlookTest, LooksAtAnyRhythmOfTwoOrMore) {
  using test::clicks;
  for (const ContactSignature& signature :
       {clicks({{0, 0, 1, 0, 1}, {0.2, 0, 0, 0, 1}}, true),
        clicks({{0, 0.1, 1, 0, 1}, {0.1, 0, 1e-9, 0, 1}, {0.1 + 1e-9, 0, 9, 0, 1}}, false)}) {
    EXPECT_TRUE(rhythmFeatures(signature).allFinite());
  }
}

}  // namespace
}  // namespace ifa
