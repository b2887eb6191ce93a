// SPDX-License-Identifier: Apache-2.0
#include "planner/rhythm_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "body/object_file.h"
#include "planner/shooting_cases.h"

namespace ifa {
namespace {

constexpr int kDrops = 400;

RhythmLikelihood learn(const Body& body) {
  const SurfaceProperties& surface = body.definition.surfaces.at("desk");
  return RhythmLikelihood::learn(body, surface, audibleCut(body, surface), kDrops);
}

TEST(RhythmLikelihoodTest, KnowsWhichBodyMadeARhythm) {
  const Body& die = test::die();
  const Body eraser = loadObject("Eraser").value();
  const RhythmLikelihood ofDie = learn(die), ofEraser = learn(eraser);
  int right = 0;
  constexpr int kCount = 20;
  for (const ContactSignature& rhythm : test::signatures(die, kCount, 2, 5000)) {
    if (ofDie.log(rhythm) > ofEraser.log(rhythm)) ++right;
  }
  for (const ContactSignature& rhythm : test::signatures(eraser, kCount, 2, 5000)) {
    if (ofEraser.log(rhythm) > ofDie.log(rhythm)) ++right;
  }
  EXPECT_GE(right, 36);  // of 40
}

TEST(RhythmLikelihoodTest, IsTheDensityOfATDistribution) {
  // W = 2, mean 0: all features but the first scaled by two.
  RhythmLikelihood::Coefficients known;
  for (int k = 0; k < RhythmLikelihood::kFeatures; ++k) {
    known.whitening[static_cast<std::size_t>(k * (RhythmLikelihood::kFeatures + 1))] = 2;
  }
  known.heard = 0.5;
  const ContactSignature rhythm = test::signatureOfDrop(test::die(), 3);
  const double square = rhythmFeatures(rhythm).squaredNorm() - 1;
  constexpr int kCount = RhythmLikelihood::kFeatures;
  const double expected =
      std::log(0.5) + kCount * std::log(2) - 0.5 * (10 + kCount) * std::log(1 + 4 * square / 10);
  EXPECT_NEAR(RhythmLikelihood(known).log(rhythm), expected, 1e-9);
  known.heard = 0;
  EXPECT_EQ(RhythmLikelihood(known).log(rhythm), -INFINITY);
}

TEST(RhythmLikelihoodTest, ComesBackFromItsCoefficients) {
  const RhythmLikelihood likelihood = learn(test::die()), again(likelihood.coefficients());
  const ContactSignature rhythm = test::signatureOfDrop(test::die(), 3);
  EXPECT_EQ(likelihood.log(rhythm), again.log(rhythm));
}

TEST(RhythmLikelihoodTest, TheSameForAnyNumberOfThreads) {
  setThreadCount(1);
  const auto one = learn(test::die()).coefficients();
  setThreadCount(2);
  const auto two = learn(test::die()).coefficients();
  setThreadCount(0);
  EXPECT_EQ(one.mean, two.mean);
  EXPECT_EQ(one.whitening, two.whitening);
  EXPECT_EQ(one.heard, two.heard);
}

}  // namespace
}  // namespace ifa
