// SPDX-License-Identifier: Apache-2.0
// Events found in rows of contact steps made by hand.
#include "sampler/event_recorder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ifa {
namespace {

using Eigen::Vector3d;

constexpr double kWeight = 0.05;     // N
constexpr double kThreshold = 1e-4;  // N s
constexpr double kQuietShare = 2 * kWeight * 1e-3;

RecorderSettings listening() {
  RecorderSettings settings;
  settings.weight = kWeight;
  settings.threshold = kThreshold;
  return settings;
}

/// States carry the time in their position, so that one can tell which were kept.
ContactStep stepOf(double time, double duration, const Vector3d& impulse) {
  ContactStep step;
  step.time = time;
  step.duration = duration;
  step.impulse = impulse;
  step.before.position.x() = time;
  step.after.position.x() = time + duration;
  step.touching = duration > 0;
  return step;
}
ContactStep impact(double time, double impulse) { return stepOf(time, 0, {0, 0, impulse}); }
/// A millisecond of silent contact: just the weight.
ContactStep resting(double time) { return stepOf(time, 1e-3, {0, 0, kWeight * 1e-3}); }

std::vector<ContactEvent> record(const std::vector<ContactStep>& steps, bool atRest = false,
                                 const RecorderSettings& settings = listening()) {
  EventRecorder recorder(settings);
  for (const ContactStep& step : steps) recorder.add(step);
  return recorder.finish(atRest);
}

TEST(EventRecorderTest, NothingGivesNothing) {
  EXPECT_TRUE(record({}).empty());
  EXPECT_TRUE(record({}, true).empty());
}

TEST(EventRecorderTest, OneImpactIsOneDiscreteEvent) {
  const auto events = record({impact(0.25, 0.01)});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].start, 0.25);
  EXPECT_EQ(events[0].end, 0.25);
  EXPECT_EQ(events[0].filteredDuration(0.010), 0);
  EXPECT_NEAR(events[0].amplitude, 0.01 - kQuietShare, 1e-15);
  EXPECT_EQ(events[0].centroid, 0);
  EXPECT_FALSE(events[0].terminal);
  EXPECT_FALSE(events[0].touchingAfter);
  EXPECT_EQ(events[0].before.position.x(), 0.25);
  EXPECT_EQ(events[0].after.position.x(), 0.25);
}

TEST(EventRecorderTest, ImpactsUnderTheThresholdAreNoEvents) {
  EXPECT_TRUE(record({impact(0, kQuietShare + 0.99 * kThreshold)}).empty());
  EXPECT_EQ(record({impact(0, kQuietShare + 1.01 * kThreshold)}).size(), 1U);
}

TEST(EventRecorderTest, GapsUnderTheMergeGapAreClosed) {
  const auto near = record({impact(0, 0.01), impact(0.009, 0.01)});
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].end, 0.009);
  EXPECT_EQ(near[0].filteredDuration(0.010), 0);  // still shorter than the gap: a click
  EXPECT_EQ(record({impact(0, 0.01), impact(0.011, 0.01)}).size(), 2U);
  RecorderSettings slow = listening();
  slow.mergeGap = 0.030;
  EXPECT_EQ(record({impact(0, 0.01), impact(0.029, 0.01)}, false, slow).size(), 1U);
  EXPECT_EQ(record({impact(0, 0.01), impact(0.031, 0.01)}, false, slow).size(), 2U);
}

TEST(EventRecorderTest, MergingGoesOnFromTheLastImpact) {
  const auto events =
      record({impact(0, 0.01), impact(0.008, 0.01), impact(0.016, 0.01), impact(0.030, 0.01)});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].end, 0.016);
  EXPECT_EQ(events[0].filteredDuration(0.010), 0.016);
  EXPECT_EQ(events[1].start, 0.030);
}

TEST(EventRecorderTest, AnInaudibleTouchJoinsNothing) {
  // Without the soft touch in between, the gap is 16 ms.
  const auto events = record({impact(0, 0.01), impact(0.008, 1e-5), impact(0.016, 0.01)});
  EXPECT_EQ(events.size(), 2U);
}

TEST(EventRecorderTest, TheShareThatCarriesTheWeightIsSilent) {
  std::vector<ContactStep> steps;
  for (int i = 0; i < 200; ++i) steps.push_back(resting(i * 1e-3));
  EXPECT_TRUE(record(steps, true).empty());
}

TEST(EventRecorderTest, SmallStepsOfSustainedContactAreSilentToo) {
  std::vector<ContactStep> steps;
  for (int i = 0; i < 500; ++i) steps.push_back(stepOf(i * 0.3e-3, 0.3e-3, {0, 0, kWeight * 3e-4}));
  EXPECT_TRUE(record(steps).empty());
}

TEST(EventRecorderTest, RubbingIsHeardByItsExcess) {
  std::vector<ContactStep> steps;
  const double excess = 3 * kThreshold;
  for (int i = 0; i < 40; ++i) {
    steps.push_back(stepOf(i * 1e-3, 1e-3, {0, 0, kQuietShare + excess}));
  }
  const auto events = record(steps);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].end, 0.040, 1e-12);
  EXPECT_NEAR(events[0].amplitude, excess * std::sqrt(40.0), 1e-12);
  EXPECT_NEAR(events[0].centroid, 0.0195, 1e-9);
  EXPECT_TRUE(events[0].touchingAfter);
}

TEST(EventRecorderTest, AnEventEndsWithItsLastAudibleImpulse) {
  std::vector<ContactStep> steps = {impact(0, 0.01), impact(0.015, 0.01)};
  for (int i = 0; i < 300; ++i) steps.push_back(resting(0.016 + i * 1e-3));
  const auto events = record(steps, true);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].end, 0.015);
  EXPECT_EQ(events[1].after.position.x(), 0.015);
  EXPECT_TRUE(events[1].terminal);
  EXPECT_FALSE(events[0].terminal);
}

TEST(EventRecorderTest, OnlyABodyAtRestMakesItsLastEventTerminal) {
  EXPECT_FALSE(record({impact(0, 0.01)}, false)[0].terminal);
  EXPECT_TRUE(record({impact(0, 0.01)}, true)[0].terminal);
}

TEST(EventRecorderTest, AnImpactInSilentContactStartsExactlyAtItsTime) {
  std::vector<ContactStep> steps;
  for (int i = 0; i < 50; ++i) steps.push_back(resting(i * 1e-3));
  steps.push_back(stepOf(0.050, 0.4e-3, {0, 0, kWeight * 0.4e-3}));
  steps.push_back(impact(0.0504, 0.01));
  const auto events = record(steps);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].start, 0.0504);
  EXPECT_EQ(events[0].before.position.x(), 0.0504);
  EXPECT_NEAR(events[0].amplitude, 0.01 - kQuietShare, 1e-15);
}

TEST(EventRecorderTest, ImpulsesOfOneMillisecondAddUpAsVectors) {
  const auto events =
      record({stepOf(0, 0, {0.003, 0, 0.004}), stepOf(0.4e-3, 0, {-0.003, 0, 0.004}),
              stepOf(0.9e-3, 0, {0, 0.006, 0})});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].amplitude, 0.010 - kQuietShare, 1e-15);  // |(0, 0.006, 0.008)|
}

TEST(EventRecorderTest, ANewMillisecondIsANewBin) {
  const auto events = record({impact(0, 0.003), impact(1.0e-3, 0.004)});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].amplitude, std::hypot(0.003 - kQuietShare, 0.004 - kQuietShare), 1e-15);
}

TEST(EventRecorderTest, AmplitudeIsTheTwoNormAndCentroidTheMeanTime) {
  RecorderSettings light = listening();
  light.weight = 0;
  const auto events =
      record({impact(0.5, 0.003), impact(0.505, 0.004), impact(0.510, 0.012)}, false, light);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].amplitude, 0.013, 1e-15);
  EXPECT_NEAR(events[0].centroid, (0.005 * 4 + 0.010 * 12) / 19, 1e-12);
}

TEST(EventRecorderTest, ThePapersCutHearsEveryImpulse) {
  RecorderSettings paper = listening();
  paper.audible = false;
  std::vector<ContactStep> steps = {impact(0, 0.01)};
  for (int i = 1; i < 30; ++i) steps.push_back(resting(i * 1e-3));
  const auto events = record(steps, true, paper);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NEAR(events[0].end, 0.030, 1e-12);
  const double each = kWeight * 1e-3;
  EXPECT_NEAR(events[0].amplitude, std::sqrt(1e-4 + 29 * each * each), 1e-12);
  EXPECT_EQ(record({impact(0, 1e-9)}, false, paper).size(), 1U);
  EXPECT_TRUE(record({impact(0, 0)}, false, paper).empty());
}

TEST(EventRecorderTest, TimeThatElapsesClosesTheBin) {
  EventRecorder recorder(listening());
  recorder.add(impact(0.1, 0.01));
  EXPECT_TRUE(recorder.events().empty());  // more may come in the same millisecond
  recorder.elapse(0.1005);
  EXPECT_TRUE(recorder.events().empty());
  recorder.elapse(0.101);
  ASSERT_EQ(recorder.events().size(), 1U);
  recorder.elapse(5);
  EXPECT_EQ(recorder.finish(false).size(), 1U);
}

TEST(EventRecorderTest, LargestImpulseIsThatOfABin) {
  EventRecorder recorder(listening());
  recorder.add(impact(0, 0.002));
  recorder.add(impact(0.2e-3, 0.003));
  recorder.add(impact(0.1, 0.004));
  (void)recorder.finish(false);
  EXPECT_NEAR(recorder.largestImpulse(), 0.005, 1e-15);
}

TEST(EventRecorderTest, EventsSoFarAreThoseOfTheEnd) {
  EventRecorder recorder(listening());
  recorder.add(impact(0, 0.01));
  recorder.add(impact(0.1, 0.01));
  ASSERT_EQ(recorder.events().size(), 1U);  // the second bin is still open
  EXPECT_EQ(recorder.finish(false).size(), 2U);
}

}  // namespace
}  // namespace ifa
