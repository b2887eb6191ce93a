// SPDX-License-Identifier: Apache-2.0
#include "sampler/listened_signature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sampler/drop_statistics.h"
#include "support/box_body.h"

namespace ifa {
namespace {

ContactEvent eventAt(double start, double end, double amplitude) {
  ContactEvent event;
  event.start = start;
  event.end = end;
  event.amplitude = amplitude;
  event.centroid = (end - start) / 2;
  return event;
}

std::vector<ContactEvent> someEvents() {
  std::vector<ContactEvent> events = {eventAt(0.1, 0.1, 2), eventAt(0.111, 0.112, 1),
                                      eventAt(0.2, 0.25, 4), eventAt(0.2605, 0.262, 0.5)};
  events.back().terminal = true;
  return events;
}

TEST(ListenedSignature, WithoutErrorsItIsTheEventsFiltered) {
  RandomStream random(1, 1);
  const ContactSignature s = listenTo(someEvents(), {0, 0, 0, 0.010}, random);
  ASSERT_EQ(s.events.size(), 4U);
  EXPECT_TRUE(s.terminal);
  EXPECT_EQ(s.events[0].time, 0);
  EXPECT_NEAR(s.events[1].time, 0.011, 1e-9);
  EXPECT_EQ(s.events[1].duration, 0);
  EXPECT_NEAR(s.events[2].duration, 0.05, 1e-9);
  EXPECT_NEAR(s.events[2].centroid, 0.025, 1e-9);
  EXPECT_NEAR(s.events[2].amplitude, 2, 1e-9);
  EXPECT_EQ(s.events[3].centroid, 0);
}

TEST(ListenedSignature, ErrorsStayInBoundsAndNothingMerges) {
  const std::vector<ContactEvent> events = someEvents();
  const ListenerSettings settings;
  bool sawJitter = false;
  for (std::uint64_t i = 0; i < 500; ++i) {
    RandomStream random(7, i);
    const ContactSignature s = listenTo(events, settings, random);
    ASSERT_EQ(s.events.size(), events.size());
    for (std::size_t k = 0; k < events.size(); ++k) {
      const SignatureEvent& e = s.events[k];
      const double before = events[k].start - events[0].start;
      // Two jitters; and a merge gap pushed on by the event before.
      EXPECT_LE(std::abs(e.time - before), 0.012);
      EXPECT_GE(e.amplitude, 0.6999 * events[k].amplitude / events[0].amplitude);
      EXPECT_LE(e.amplitude, 1.3001 * events[k].amplitude / events[0].amplitude);
      EXPECT_TRUE(e.duration == 0 || e.duration >= settings.mergeGap - 1e-9);
      EXPECT_LE(e.centroid, e.duration);
      if (k > 0) {
        const SignatureEvent& last = s.events[k - 1];
        EXPECT_GE(e.time - last.time - last.duration, settings.mergeGap - 2e-6);
      }
      sawJitter = sawJitter || std::abs(e.time - before) > 0.002;
    }
  }
  EXPECT_TRUE(sawJitter);
  RandomStream random(7, 0);
  EXPECT_TRUE(listenTo({}, settings, random).events.empty());
}

TEST(ListenedSignature, ScaledBodyKeepsDensityAndShape) {
  const Body small = makeBoxBody({0.02, 0.03, 0.04}, 0.01);
  const Body expected = makeBoxBody({0.03, 0.045, 0.06}, 0.01 * 1.5 * 1.5 * 1.5);
  const Body scaled = scaledBody(small, 1.5);
  EXPECT_NEAR(scaled.mass, expected.mass, 1e-12);
  EXPECT_LT((scaled.principalMoments - expected.principalMoments).norm(), 1e-15);
  EXPECT_LT((scaled.hull[5] - expected.hull[5]).norm(), 1e-15);
  EXPECT_NEAR(scaled.radius, expected.radius, 1e-12);
  EXPECT_NEAR(scaled.size, expected.size, 1e-12);
}

TEST(ListenedSignature, EnergyRiseIsSeenAcrossAndBetweenEvents) {
  const Body die = makeDieBody();
  std::vector<ContactEvent> events(2);
  const auto moving = [](double speed) {
    RigidState state;
    state.velocity.z() = speed;
    return state;
  };
  events[0].before = moving(-2);
  events[0].after = moving(1);
  events[1].before = moving(-1);
  events[1].after = moving(0.5);
  EXPECT_DOUBLE_EQ(largestEnergyRise(die, events), 0);
  events[0].after = moving(2.1);
  EXPECT_NEAR(largestEnergyRise(die, events), die.mass * (2.1 * 2.1 - 4) / 2, 1e-12);
  events[0].after = moving(1);
  events[1].before = moving(-1.5);
  EXPECT_NEAR(largestEnergyRise(die, events), die.mass * (1.5 * 1.5 - 1) / 2, 1e-12);
}

TEST(ListenedSignature, ChoosesSamplesOfTheMeanAskedFor) {
  std::vector<double> values(1000);
  RandomStream random(3, 1);
  for (double& value : values) value = std::floor(random.uniform(1, 21) + random.uniform(0, 5));
  for (const double target : {6.0, 12.5, 20.0}) {
    const auto chosen = chooseByMean(values, 20, target);
    ASSERT_EQ(chosen.size(), 20U);
    double sum = 0;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      if (k > 0) {
        EXPECT_LT(chosen[k - 1], chosen[k]);
      }
      sum += values[chosen[k]];
    }
    EXPECT_NEAR(sum / 20, target, 0.1 * target);
  }
  EXPECT_EQ(chooseByMean({5, 1, 3}, 3, 100).size(), 3U);
  EXPECT_EQ(chooseByMean({5, 1, 3, 9}, 1, 100), (std::vector<std::size_t>{3}));
}

}  // namespace
}  // namespace ifa
