// SPDX-License-Identifier: Apache-2.0
// Distances and places, judged by the audit's method, which shares nothing with either.
#include "ensemble/place_bodies.h"

#include <gtest/gtest.h>

#include "audit/separation.h"
#include "base/random.h"
#include "ensemble/hull_gap.h"
#include "ensemble/made_motions.h"
#include "support/box_body.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using test::madeMotion;
using test::stillMotion;

Pose randomPose(RandomStream& random, double reach) {
  const auto draw = [&] { return random.uniform(-1, 1); };
  return {reach * Vector3d(draw(), draw(), draw()),
          Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized()};
}

TEST(HullGap, OfBoxesSideBySide) {
  const Body die = makeDieBody();
  const Hull hull{&die.hull, die.radius};
  const Pose origin;
  const auto gapAt = [&](const Pose& pose) { return hullGap(hull, origin, hull, pose, 1); };
  EXPECT_NEAR(gapAt({{0.020, 0, 0}, Eigen::Quaterniond::Identity()}), 0.004, 1e-5);
  EXPECT_NEAR(gapAt({{0.019, 0.020, 0}, Eigen::Quaterniond::Identity()}), 0.005, 1e-5);
  EXPECT_NEAR(gapAt({{0.018, 0.018, 0.017}, Eigen::Quaterniond::Identity()}), 0.003, 1e-5);
  EXPECT_EQ(gapAt({{0.015, 0, 0}, Eigen::Quaterniond::Identity()}), 0);
  EXPECT_EQ(gapAt(origin), 0);
}

TEST(HullGap, AgreesWithTheAuditInAnyPose) {
  const Body die = makeDieBody(), plank = makeBoxBody({0.06, 0.02, 0.003}, 0.01);
  RandomStream random(1, 2);
  int apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose one = randomPose(random, 0.03), other = randomPose(random, 0.03);
    const double gap = hullGap({&die.hull, die.radius}, one, {&plank.hull, plank.radius}, other, 1);
    Motion first = stillMotion(one.position), second = stillMotion(other.position);
    for (MotionSample& sample : first.trajectory) sample.orientation = one.orientation;
    for (MotionSample& sample : second.trajectory) sample.orientation = other.orientation;
    const Separation found = leastSeparation({{&first, &die}, {&second, &plank}}, 1);
    EXPECT_NEAR(gap, std::max(found.least, 0.0), 1e-4) << i;
    apart += gap > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
  EXPECT_LT(apart, 390);
}

/// Bodies that all rush through the same place at the same time, hop, and stop there.
struct Crowd {
  explicit Crowd(int count) {
    for (int i = 0; i < count; ++i) {
      const double way = 0.1 * (i % 3);
      motions.push_back(madeMotion(0.5 + 0.05 * i, -0.3, 1, [=](double t) {
        const double left = std::max(0.0, 0.5 - t);
        return Vector3d(way * left + 3 * left * left, 0,
                        0.008 + 0.1 * std::abs(std::sin(9 * left)));
      }));
    }
    for (const Motion& motion : motions) members.push_back({&motion, &die});
  }
  [[nodiscard]] Separation separation(const std::vector<FloorPlace>& places) const {
    std::vector<LaidMotion> laid;
    for (std::size_t i = 0; i < places.size(); ++i) {
      laid.push_back({&motions[i], &die, places[i].turn, places[i].shift});
    }
    return leastSeparation(laid);
  }

  Body die = makeDieBody();
  std::vector<Motion> motions;
  std::vector<EnsembleMember> members;
};

TEST(PlaceBodies, KeepsACrowdApart) {
  const Crowd crowd(9);
  EXPECT_LE(crowd.separation(std::vector<FloorPlace>(9)).least, 0) << "unless they are placed";
  const auto places = placeBodies(crowd.members, {0.004, 3});
  ASSERT_TRUE(places) << places.error().text();
  const Separation found = crowd.separation(*places);
  EXPECT_TRUE(found.known);
  EXPECT_GE(found.least, 0.004 - 2e-5);
  double furthest = 0;
  for (std::size_t i = 0; i < places->size(); ++i) {
    const Pose end = (*places)[i].apply(PoseTrack(crowd.motions[i]).at(1));
    furthest = std::max(furthest, end.position.head<2>().norm());
  }
  EXPECT_LT(furthest, 0.5) << "and together";
}

TEST(PlaceBodies, IsTheSameForTheSameSeedOnly) {
  const Crowd crowd(3);
  const auto one = placeBodies(crowd.members, {0.004, 3}),
             again = placeBodies(crowd.members, {0.004, 3}),
             other = placeBodies(crowd.members, {0.004, 4});
  ASSERT_TRUE(one && again && other);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*one)[i].turn, (*again)[i].turn);
    EXPECT_EQ((*one)[i].shift, (*again)[i].shift);
    EXPECT_NE((*one)[i].turn, (*other)[i].turn);
  }
}

// At 20 m/s a body passes another one between two samples of any sensible rate.
TEST(PlaceBodies, SeesWhatIsFasterThanItsSamples) {
  const Body die = makeDieBody();
  const Motion post = madeMotion(1, 0, 1, [](double) { return Vector3d(0, 0, 0.008); });
  const Motion bullet =
      madeMotion(1, 0, 1, [](double t) { return Vector3d(20 * (t - 0.502), 0, 0.008); });
  const auto places = placeBodies({{&post, &die}, {&bullet, &die}}, {0.004, 1});
  ASSERT_TRUE(places) << places.error().text();
  const Separation found = leastSeparation({{&post, &die, (*places)[0].turn, (*places)[0].shift},
                                            {&bullet, &die, (*places)[1].turn, (*places)[1].shift}},
                                           20000);
  EXPECT_GE(found.least, 0.004 - 2e-5);
}

TEST(PlaceBodies, StopsWhenAsked) {
  const Crowd crowd(3);
  std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const auto places = placeBodies(crowd.members, {0.004, 3}, progress);
  ASSERT_FALSE(places);
  EXPECT_EQ(places.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace ifa
