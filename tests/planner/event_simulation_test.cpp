// SPDX-License-Identifier: Apache-2.0
#include "planner/event_simulation.h"

#include <gtest/gtest.h>

#include "dynamics/simulator.h"
#include "planner/bodies.h"

namespace ifa {
namespace {

using test::sameBits;

/// The state that a replay reaches where the event ends, or nothing.
bool replays(const BodyModel& model, const ContactEvent& event, double restitution) {
  Stepper stepper(model);
  stepper.start(kernelState(event.before, 0), restitution);
  while (stepper.state().time < event.end + 0.01) {
    const Advance did = stepper.advance(event.end + 1);
    if (did == Advance::kRest) return false;
    if (did != Advance::kImpact && did != Advance::kContact) continue;
    if (stepper.state().time > event.end - 1e-9 &&
        sameBits(rigidState(stepper.state()), event.after))
      return true;
  }
  return false;
}

class EventSimulationTest : public testing::TestWithParam<std::size_t> {
 protected:
  EventSimulationTest()
      : ground_(test::grounds()[GetParam()]),
        model_(ground_.body, ground_.surface),
        settings_(audibleCut(ground_.body, ground_.surface)),
        simulation_(model_, settings_) {}

  [[nodiscard]] RigidState arrival(std::uint64_t index) const {
    return sampleInitialState(ground_.body, 21, index);
  }

  /// About to slap down, more or less flat, more or less slowly.
  [[nodiscard]] RigidState nearlyFlat(std::uint64_t index) const {
    RigidState state = arrival(index);
    const double tilt = 2e-4 * static_cast<double>(index);
    state.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(tilt, state.angularVelocity.normalized()));
    state.position.z() = -lowestVertex(state);
    state.velocity = {0, 0, -0.1 - 0.01 * static_cast<double>(index)};
    state.angularVelocity.setZero();
    return state;
  }
  /// Height of the lowest vertex above the centre of mass in this pose, m.
  [[nodiscard]] double lowestVertex(const RigidState& state) const {
    double lowest = 1e9;
    for (std::size_t i = 0; i < model_.x.size(); ++i) {
      const Eigen::Vector3d p(model_.x[i], model_.y[i], model_.z[i]);
      lowest = std::min(lowest, (state.orientation * p).z());
    }
    return lowest;
  }

  test::Ground ground_;
  BodyModel model_;
  RecorderSettings settings_;
  EventSimulation simulation_;
  std::vector<ContactEvent> ways_;
};

TEST_P(EventSimulationTest, TheNaturalEventIsTheFirstOfTheWholeDrop) {
  int seen = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto whole = eventsOf(simulateDrop(model_, arrival(i), 10), settings_);
    simulation_.outcomes(arrival(i), model_.surface.restitution, false, false, ways_);
    if (whole.empty() || whole[0].start > 0 || whole[0].terminal) {
      EXPECT_TRUE(ways_.empty()) << i;
      continue;
    }
    ++seen;
    ASSERT_EQ(ways_.size(), 1U) << i;
    EXPECT_EQ(ways_[0].start, 0);
    EXPECT_EQ(ways_[0].end, whole[0].end);
    EXPECT_EQ(ways_[0].amplitude, whole[0].amplitude);
    EXPECT_EQ(ways_[0].centroid, whole[0].centroid);
    EXPECT_EQ(ways_[0].touchingAfter, whole[0].touchingAfter);
    EXPECT_FALSE(ways_[0].terminal);
    EXPECT_TRUE(sameBits(ways_[0].after, whole[0].after));
    EXPECT_TRUE(sameBits(ways_[0].before, arrival(i)));
  }
  EXPECT_GT(seen, 20);
}

TEST_P(EventSimulationTest, CutsArePrefixesOfTheNaturalEvent) {
  std::size_t cuts = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    simulation_.outcomes(arrival(i), model_.surface.restitution, false, true, ways_);
    const std::vector<ContactEvent> all = ways_;
    simulation_.outcomes(arrival(i), model_.surface.restitution, false, false, ways_);
    if (ways_.empty()) continue;
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all[0].end, ways_[0].end);  // the natural one comes first
    EXPECT_TRUE(sameBits(all[0].after, ways_[0].after));
    for (std::size_t k = 1; k < all.size(); ++k) {
      ++cuts;
      EXPECT_LT(all[k].end, all[0].end);
      EXPECT_LE(all[k].amplitude, all[0].amplitude);
      if (k > 1) {
        EXPECT_GT(all[k].end, all[k - 1].end);
      }
      EXPECT_TRUE(sameBits(all[k].before, arrival(i)));
    }
  }
  EXPECT_GT(cuts, 5U);
}

TEST_P(EventSimulationTest, EveryWayReplaysToTheSameBits) {
  const double restitution = 1.1 * model_.surface.restitution;
  for (std::uint64_t i = 0; i < 40; ++i) {
    simulation_.outcomes(arrival(i), restitution, false, true, ways_);
    for (const ContactEvent& event : ways_) EXPECT_TRUE(replays(model_, event, restitution)) << i;
    simulation_.outcomes(arrival(i), restitution, true, true, ways_);
    for (const ContactEvent& event : ways_) EXPECT_TRUE(replays(model_, event, restitution)) << i;
  }
}

TEST_P(EventSimulationTest, ABodyLeftToItselfIsNextHeardWhereTheWholeSimulationSays) {
  int heard = 0;
  for (const ContactEvent& event : test::firstContacts(ground_, model_, 60)) {
    const DropResult drop = simulateDrop(model_, event.after, 10);
    const auto whole = eventsOf(drop, settings_);
    const auto next = simulation_.nextAudible(event.after, 2);
    ASSERT_EQ(next.has_value(), !whole.empty());
    if (!next) continue;
    ++heard;
    EXPECT_EQ(next->delay, whole[0].start);
    EXPECT_TRUE(sameBits(next->state, whole[0].before));
  }
  EXPECT_GT(heard, 30);
}

TEST_P(EventSimulationTest, TellsWhetherItTouchedOnTheWay) {
  int wrong = 0, silent = 0;
  for (const ContactEvent& event : test::firstContacts(ground_, model_, 300)) {
    const auto next = simulation_.nextAudible(event.after, 2);
    if (!next) continue;
    const DropResult drop = simulateDrop(model_, event.after, 10);
    bool touched = false;
    for (const ContactStep& step : drop.steps) touched = touched || step.time < next->delay;
    if (touched) ++silent;
    if (touched != next->silentContact) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
  if (GetParam() == 1) {
    EXPECT_GT(silent, 0);  // a flat box often touches too softly to be heard
  }
}

TEST_P(EventSimulationTest, HowFarItLooksDoesNotChangeWhatItSees) {
  int seen = 0;
  for (const ContactEvent& event : test::firstContacts(ground_, model_, 100)) {
    const auto far = simulation_.nextAudible(event.after, 2);
    if (!far) continue;
    const auto near = simulation_.nextAudible(event.after, far->delay + 1e-3);
    ASSERT_TRUE(near.has_value());
    ++seen;
    EXPECT_EQ(near->delay, far->delay);
    EXPECT_TRUE(sameBits(near->state, far->state));
  }
  EXPECT_GT(seen, 50);
}

TEST_P(EventSimulationTest, LooksNoFartherThanAsked) {
  for (const ContactEvent& event : test::firstContacts(ground_, model_, 20)) {
    const auto next = simulation_.nextAudible(event.after, 2);
    if (!next || next->delay < 0.02) continue;
    EXPECT_FALSE(simulation_.nextAudible(event.after, next->delay - 0.01).has_value());
  }
}

TEST_P(EventSimulationTest, TerminalWaysEndInRestWithoutAnotherSound) {
  constexpr double kDull = 0.1;
  const BodyModel model(ground_.body, test::surfaceOf(ground_.body, kDull));
  EventSimulation simulation(model, settings_);
  int found = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const RigidState slow = nearlyFlat(i);
    const auto whole = eventsOf(simulateDrop(model, slow, 10), settings_);
    simulation.outcomes(slow, kDull, true, true, ways_);
    const bool ends = whole.size() == 1 && whole[0].terminal && whole[0].start == 0;
    ASSERT_EQ(ways_.size(), ends ? 1U : 0U) << i;
    if (ends) {
      ++found;
      EXPECT_TRUE(ways_[0].terminal);
      EXPECT_EQ(ways_[0].end, whole[0].end);
      EXPECT_TRUE(sameBits(ways_[0].after, whole[0].after));
    }
    // A target that is not terminal takes no terminal event.
    simulation.outcomes(slow, kDull, false, true, ways_);
    for (const ContactEvent& way : ways_) EXPECT_FALSE(way.terminal);
  }
  EXPECT_GT(found, 10);
  EXPECT_LT(found, 60);
}

INSTANTIATE_TEST_SUITE_P(Bodies, EventSimulationTest, testing::Values(0, 1, 2));

/// A die that falls flat.
RigidState flatDie(double speed) {
  RigidState state;
  state.position.z() = 0.008;
  state.velocity.z() = -speed;
  return state;
}

/// Velocities are as good as the contact solver leaves them, m/s.
constexpr double kSolved = 3e-5;

TEST(DieEventTest, AFlatFallBouncesOnce) {
  const test::Ground ground = test::onGround(makeDieBody(), 0.5);
  const BodyModel model(ground.body, ground.surface);
  EventSimulation simulation(model, audibleCut(ground.body, ground.surface));
  std::vector<ContactEvent> ways;
  simulation.outcomes(flatDie(2), 0.5, false, true, ways);
  ASSERT_EQ(ways.size(), 1U);
  EXPECT_EQ(ways[0].end, 0);
  EXPECT_NEAR(ways[0].after.velocity.z(), 1, kSolved);
  const double weight = ground.body.mass * kGravity;
  EXPECT_NEAR(ways[0].amplitude, ground.body.mass * 3 - 2 * weight * 1e-3,
              ground.body.mass * kSolved);
  // The restitution is the one asked for, not the surface's.
  simulation.outcomes(flatDie(2), 0.8, false, true, ways);
  ASSERT_EQ(ways.size(), 1U);
  EXPECT_NEAR(ways[0].after.velocity.z(), 1.6, kSolved);
  // Up at 1 m/s and down again; what spin the solver left brings one corner down a little earlier.
  simulation.outcomes(flatDie(2), 0.5, false, true, ways);
  const auto next = simulation.nextAudible(ways[0].after, 1);
  ASSERT_TRUE(next.has_value());
  EXPECT_NEAR(next->delay, 2 / kGravity, 5e-5);
  EXPECT_FALSE(next->silentContact);
}

TEST(DieEventTest, ASlapThatDoesNotBounceIsTerminal) {
  const test::Ground ground = test::onGround(makeDieBody(), 0);
  const BodyModel model(ground.body, ground.surface);
  EventSimulation simulation(model, audibleCut(ground.body, ground.surface));
  std::vector<ContactEvent> ways;
  simulation.outcomes(flatDie(0.5), 0, true, false, ways);
  ASSERT_EQ(ways.size(), 1U);
  EXPECT_TRUE(ways[0].terminal);
  EXPECT_LT(ways[0].end, 0.002);
  EXPECT_LT(ways[0].after.velocity.norm(), 0.01);
  EXPECT_FALSE(simulation.nextAudible(ways[0].after, 1).has_value());
}

TEST(DieEventTest, ATouchTooSoftToHearIsNoEvent) {
  const test::Ground ground = test::onGround(makeDieBody(), 0.5);
  const BodyModel model(ground.body, ground.surface);
  EventSimulation simulation(model, audibleCut(ground.body, ground.surface));
  std::vector<ContactEvent> ways;
  simulation.outcomes(flatDie(0.01), 0.5, false, true, ways);
  EXPECT_TRUE(ways.empty());
}

}  // namespace
}  // namespace ifa
