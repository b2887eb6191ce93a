// SPDX-License-Identifier: Apache-2.0
#include "sampler/event_chain.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"
#include "support/box_body.h"

namespace ifa {
namespace {

constexpr double kTimeLimit = 20;  // s
constexpr int kDrops = 60;

class EventChainTest : public testing::TestWithParam<double> {
 protected:
  EventChainTest() {
    surface_.restitution = GetParam();
    surface_.referenceImpulse = 0.0147;
  }
  [[nodiscard]] std::vector<EventRecord> simulate(std::uint64_t index) {
    std::vector<EventRecord> records;
    EventChain(model(), cut()).simulate(sampleInitialState(die_, 1, index), kTimeLimit, records);
    return records;
  }
  [[nodiscard]] RecorderSettings cut() const { return audibleCut(die_, surface_); }
  const BodyModel& model() {
    if (!model_) model_ = std::make_unique<BodyModel>(die_, surface_);
    return *model_;
  }

  Body die_ = makeDieBody();
  SurfaceProperties surface_;
  std::unique_ptr<BodyModel> model_;
};

TEST_P(EventChainTest, EveryRecordIsGivenAgainByItsPreContactState) {
  EventChain chain(model(), cut());
  for (std::uint64_t i = 0; i < kDrops; ++i) {
    for (const EventRecord& stored : simulate(i)) {
      const ChainLink link = chain.follow(stored.before, kTimeLimit);
      ASSERT_TRUE(link.heard);
      EXPECT_EQ(link.event.before.orientation.coeffs(), unpack(stored.before).orientation.coeffs());
      EXPECT_EQ(link.event.before.angularVelocity, unpack(stored.before).angularVelocity);
      const EventRecord again = recordOf(link.event);
      EXPECT_EQ(again.after, stored.after);
      EXPECT_EQ(again.shift, stored.shift);
      EXPECT_EQ(again.duration, stored.duration);
      EXPECT_EQ(again.amplitude, stored.amplitude);
      EXPECT_EQ(again.centroid, stored.centroid);
      EXPECT_EQ(again.has(EventRecord::kTerminal), stored.has(EventRecord::kTerminal));
    }
  }
}

TEST_P(EventChainTest, LeadsFromEachEventToTheNext) {
  EventChain chain(model(), cut());
  for (std::uint64_t i = 0; i < kDrops; ++i) {
    const auto records = simulate(i);
    ASSERT_FALSE(records.empty());
    for (std::size_t k = 0; k + 1 < records.size(); ++k) {
      ASSERT_TRUE(records[k].has(EventRecord::kFollowed));
      EXPECT_FALSE(records[k].has(EventRecord::kTerminal));
      EXPECT_GT(records[k].gap, 0);
      const ChainLink link = chain.follow(records[k].before, kTimeLimit);
      ASSERT_TRUE(link.followed);
      // A contact that is not heard when it starts anew is passed over.
      if (pack(link.next) != records[k + 1].before) continue;
      EXPECT_EQ(static_cast<float>(link.nextStart - link.event.end), records[k].gap);
    }
    EXPECT_TRUE(records.back().has(EventRecord::kTerminal));
    EXPECT_FALSE(records.back().has(EventRecord::kFollowed));
  }
}

TEST_P(EventChainTest, AFlightIsBallistic) {
  for (std::uint64_t i = 0; i < kDrops; ++i) {
    const auto records = simulate(i);
    for (std::size_t k = 0; k + 1 < records.size(); ++k) {
      if (records[k].has(EventRecord::kSilentPassage)) continue;
      const PackedState &from = records[k].after, &to = records[k + 1].before;
      const float gap = records[k].gap;
      EXPECT_NEAR(to.velocity[2] - from.velocity[2], -kGravity * gap, 1e-5);
      EXPECT_NEAR(from.height + gap * (from.velocity[2] + to.velocity[2]) / 2, to.height, 1e-6);
      EXPECT_NEAR(records[k].shift[0] + gap * from.velocity[0], records[k].next[0], 1e-6);
      EXPECT_NEAR(records[k].shift[1] + gap * from.velocity[1], records[k].next[1], 1e-6);
    }
  }
}

TEST_P(EventChainTest, HasTheStatisticsOfUnbrokenDrops) {
  std::size_t chained = 0, unbroken = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    chained += simulate(i).size();
    const DropResult drop = simulateDrop(model(), sampleInitialState(die_, 1, i), kTimeLimit);
    unbroken += eventsOf(drop, cut()).size();
  }
  EXPECT_NEAR(static_cast<double>(chained) / static_cast<double>(unbroken), 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Restitutions, EventChainTest, testing::Values(0.3, 0.6, 0.8));

TEST(EventChain, WhatTheTimeLimitCutsOffIsNotRecorded) {
  const Body die = makeDieBody();
  SurfaceProperties surface;
  surface.referenceImpulse = 0.0147;
  const BodyModel model(die, surface);
  EventChain chain(model, audibleCut(die, surface));
  std::vector<EventRecord> whole, cut;
  chain.simulate(sampleInitialState(die, 1, 5), 20, whole);
  chain.simulate(sampleInitialState(die, 1, 5), 0.1, cut);
  ASSERT_LT(cut.size(), whole.size());
  ASSERT_FALSE(cut.empty());
  EXPECT_FALSE(cut.back().has(EventRecord::kTerminal));
  EXPECT_FALSE(cut.back().has(EventRecord::kFollowed));
  for (std::size_t k = 0; k + 1 < cut.size(); ++k)
    EXPECT_EQ(std::memcmp(&cut[k], &whole[k], sizeof cut[k]), 0);
}

TEST(PackedState, ComesBackFromItsOwnUnpackedState) {
  const Body die = makeDieBody();
  for (std::uint64_t i = 0; i < 200; ++i) {
    const RigidState state = sampleInitialState(die, 3, i);
    const RigidState back = unpack(pack(state));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(back.velocity[axis], static_cast<float>(state.velocity[axis]));
      EXPECT_EQ(back.angularVelocity[axis], static_cast<float>(state.angularVelocity[axis]));
    }
    EXPECT_NEAR(back.orientation.norm(), 1, 1e-15);
    EXPECT_LT(back.orientation.angularDistance(state.orientation), 1e-6);
    EXPECT_NEAR(back.position.z(), state.position.z(), 1e-9);
    EXPECT_LT((back.velocity - state.velocity).norm(), 1e-6);
    EXPECT_LT((back.angularVelocity - state.angularVelocity).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace ifa
