// SPDX-License-Identifier: Apache-2.0
#include "planner/flight_timing.h"

#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "planner/bodies.h"
#include "planner/reference_flight.h"

namespace ifa {
namespace {

using test::kAnyEnergy;
using test::ReferenceFlight;

PlausibleRegion regionOf(const ContactEvent& event, const BodyModel& model) {
  return PlausibleRegion(event.after.velocity - event.before.velocity,
                         event.after.angularVelocity - event.before.angularVelocity, model.radius);
}

Coordinates randomWish(RandomStream& random, double size) {
  Coordinates wish;
  for (int axis = 0; axis < 6; ++axis) wish[axis] = random.uniform(-size, size);
  return wish;
}

/// After contacts, some of them with a spin of up to 150 rad/s.
class FlightTiming : public testing::TestWithParam<std::size_t> {
 protected:
  FlightTiming()
      : ground_(test::grounds()[GetParam()]),
        model_(ground_.body, ground_.surface),
        events_(test::firstContacts(ground_, model_, 60)) {
    for (std::size_t i = 0; i < events_.size(); i += 3) {
      events_[i].after.angularVelocity = test::randomVector(random_, 85);
    }
  }

  test::Ground ground_;
  BodyModel model_;
  std::vector<ContactEvent> events_;
  RandomStream random_{5, 7};
};

TEST_P(FlightTiming, LowestVertexIsOnTheGroundInTime) {
  int made = 0, clear = 0;
  for (const ContactEvent& event : events_) {
    const double duration = random_.uniform(0.02, 0.4);
    const auto flight = timeFlight(model_, event.after, regionOf(event, model_),
                                   randomWish(random_, 0.5), duration, kAnyEnergy);
    if (!flight) continue;
    ++made;
    ReferenceFlight reference(ground_.body, flight->departure);
    reference.advance(duration);
    EXPECT_NEAR(reference.clearance(), 0, 2e-7);
    reference.advance(1e-4);
    EXPECT_LT(reference.clearance(), 0) << "not on its way down";
    const auto touch = firstTouch(model_, flight->departure, duration + 1e-3);
    ASSERT_TRUE(touch.has_value());
    if (touch->time < duration - 1e-4) continue;  // something else touches earlier
    ++clear;
    EXPECT_NEAR(touch->time, duration, 1e-7);
  }
  EXPECT_GT(made, 45);
  EXPECT_GT(clear, 15);
}

TEST_P(FlightTiming, TellsWhatItChanged) {
  for (const ContactEvent& event : events_) {
    const PlausibleRegion region = regionOf(event, model_);
    const auto flight =
        timeFlight(model_, event.after, region, randomWish(random_, 0.5), 0.1, kAnyEnergy);
    if (!flight) continue;
    EXPECT_NEAR(flight->bend, region.bend(flight->velocityChange, flight->angularVelocityChange),
                1e-12 * flight->bend);
    EXPECT_EQ(flight->departure.position, event.after.position);
    EXPECT_EQ(flight->departure.velocity, event.after.velocity + flight->velocityChange);
    EXPECT_EQ(flight->departure.angularVelocity,
              event.after.angularVelocity + flight->angularVelocityChange);
    EXPECT_NEAR(flight->energy, totalEnergy(model_, flight->departure), 1e-12 * flight->energy);
  }
}

TEST_P(FlightTiming, ATimeThatFitsAlreadyNeedsNoChange) {
  for (const ContactEvent& event : events_) {
    const auto touch = firstTouch(model_, event.after, 1);
    if (!touch || touch->time < 0.02) continue;
    const auto flight = timeFlight(model_, event.after, regionOf(event, model_),
                                   Coordinates::Zero(), touch->time, kAnyEnergy);
    ASSERT_TRUE(flight.has_value());
    EXPECT_LT(flight->bend, 1e-4);
  }
}

// The nearest change to none is looked for by two steps only, and near another vertex there may be
// a smaller one; hence "nearly", and "mostly".
TEST_P(FlightTiming, WithoutAWishBendsNearlyLeast) {
  int asked = 0, beaten = 0;
  for (const ContactEvent& event : events_) {
    const PlausibleRegion region = regionOf(event, model_);
    const double duration = random_.uniform(0.03, 0.25);
    const auto least =
        timeFlight(model_, event.after, region, Coordinates::Zero(), duration, kAnyEnergy);
    if (!least || least->bend > 2) continue;
    ++asked;
    double best = least->bend;
    for (int i = 0; i < 60; ++i) {
      const Coordinates wish = randomWish(random_, 0.6 * least->bend);
      const auto other = timeFlight(model_, event.after, region, wish, duration, kAnyEnergy);
      if (other) best = std::min(best, other->bend);
    }
    if (best < 0.9 * least->bend - 0.01) ++beaten;
  }
  EXPECT_GT(asked, 15);
  EXPECT_LE(beaten, asked / 5) << "of " << asked;
}

// A cap on energy is aimed at; whether it was reached is for the caller to look at.
TEST_P(FlightTiming, ACapOnEnergyOnlyCools) {
  int hot = 0, cooled = 0;
  for (const ContactEvent& event : events_) {
    const PlausibleRegion region = regionOf(event, model_);
    const Coordinates wish = randomWish(random_, 0.5);
    const auto free = timeFlight(model_, event.after, region, wish, 0.12, kAnyEnergy);
    if (!free) continue;
    const auto same = timeFlight(model_, event.after, region, wish, 0.12, 1.01 * free->energy);
    ASSERT_TRUE(same.has_value());
    EXPECT_TRUE(test::sameBits(same->departure, free->departure)) << "the cap does not bind";
    const auto capped = timeFlight(model_, event.after, region, wish, 0.12, 0.97 * free->energy);
    if (!capped) continue;
    ++hot;
    if (capped->energy < free->energy) ++cooled;
    ReferenceFlight reference(ground_.body, capped->departure);
    reference.advance(0.12);
    EXPECT_NEAR(reference.clearance(), 0, 2e-7) << "it still takes the time asked for";
  }
  EXPECT_GT(hot, 40);
  EXPECT_GT(cooled, hot * 9 / 10);
}

// Cooling may end in a flight that arrives on its way up; what was cold enough is not refused.
TEST_P(FlightTiming, RefusesOnlyWhatIsTooHot) {
  int refused = 0;
  for (const ContactEvent& event : events_) {
    const PlausibleRegion region = regionOf(event, model_);
    const double duration = random_.uniform(0.1, 0.8), energy = totalEnergy(model_, event.before);
    const Coordinates wish = randomWish(random_, 0.5);
    const auto free = timeFlight(model_, event.after, region, wish, duration, kAnyEnergy);
    if (!free || timeFlight(model_, event.after, region, wish, duration, energy)) continue;
    ++refused;
    EXPECT_GT(free->energy, energy);
  }
  EXPECT_GT(refused, 5);
}

TEST_P(FlightTiming, FirstTouchIsThatOfTheReference) {
  for (int i = 0; i < 25; ++i) {
    RigidState start = sampleInitialState(ground_.body, 3, static_cast<std::uint64_t>(i));
    start.position.z() += random_.uniform(0.001, 0.05);
    start.velocity = test::randomVector(random_, 1.5);
    start.angularVelocity = test::randomVector(random_, i % 2 == 0 ? 15 : 80);
    const auto touch = firstTouch(model_, start, 2);
    ASSERT_TRUE(touch.has_value());
    ReferenceFlight reference(ground_.body, start);
    double earlier = 1;
    const int samples = std::max(1, static_cast<int>(touch->time / 2e-4));
    for (int s = 0; s < samples; ++s) {
      earlier = std::min(earlier, reference.clearance());
      reference.advance(touch->time / samples);
    }
    EXPECT_GT(earlier, -1e-5) << i;  // a graze is missed by less than 10 um
    EXPECT_NEAR(reference.clearance(), 0, 1e-7) << i;
    EXPECT_LT((reference.state().position - touch->state.position).norm(), 1e-9);
    EXPECT_LT(reference.state().orientation.angularDistance(touch->state.orientation), 1e-6);
    EXPECT_LT((reference.state().velocity - touch->state.velocity).norm(), 1e-9);
    EXPECT_LT((reference.state().angularVelocity - touch->state.angularVelocity).norm(), 1e-4);
  }
}

TEST_P(FlightTiming, NoTouchWithinTheLimit) {
  RigidState start;
  start.position.z() = 1;
  start.angularVelocity = {5, 6, 7};
  // A fall of one metre, but for the body's own size, takes 0.45 s.
  EXPECT_FALSE(firstTouch(model_, start, 0.4).has_value());
  EXPECT_TRUE(firstTouch(model_, start, 0.46).has_value());
}

TEST_P(FlightTiming, ATouchOnTheWayUpIsNone) {
  RigidState sunk;
  sunk.position.z() = -0.1;  // only a rise through the ground would touch it in time
  const PlausibleRegion region(Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), model_.radius);
  EXPECT_FALSE(timeFlight(model_, sunk, region, Coordinates::Zero(), 0.02, kAnyEnergy).has_value());
}

INSTANTIATE_TEST_SUITE_P(Bodies, FlightTiming, testing::Values(0, 1, 2));

}  // namespace
}  // namespace ifa
