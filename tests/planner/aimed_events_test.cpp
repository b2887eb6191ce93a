// SPDX-License-Identifier: Apache-2.0
#include "planner/aimed_events.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "body/symmetry.h"
#include "graph/edge_weight.h"
#include "planner/bodies.h"
#include "support/drop_database.h"

namespace ifa {
namespace {

constexpr double kAnyCost = std::numeric_limits<double>::infinity();

/// A contact of a drop that is left by flight, and the flight to the next one as simulated.
struct Passage {
  RigidState before, after;
  double duration;
  std::uint32_t next;
  HeardEvent heard;
};

class AimedAt : public testing::Test {
 protected:
  AimedAt() : body_(makeDieBody()), drops_(body_, 60, 3), database_(drops_.open()) {
    for (std::uint32_t i = 0; i + 1 < database_.events(); ++i) {
      all_.push_back({i, 0});
      const EventRecord from = database_.record(i);
      if (!isLeftByFlight(database_.flags(), i) || from.gap < 0.02) continue;
      passages_.push_back({unpack(from.before), unpack(from.after), from.gap, i + 1,
                           heardEvent(database_, i + 1, 1)});
    }
  }

  /// @param mirrored, turned  the source as a body with these labels sees it
  [[nodiscard]] std::vector<Aim> best(const AimedEvents& events, const Passage& passage,
                                      std::size_t count = 1, double most = kAnyCost) const {
    const PlausibleRegion region(passage.after.velocity - passage.before.velocity,
                                 passage.after.angularVelocity - passage.before.angularVelocity,
                                 body_.radius);
    return events.best(model_, {passage.after, &region, passage.duration, passage.heard, 1}, count,
                       most);
  }

  Body body_;
  test::DropDatabase drops_;
  EventDatabase database_;
  BodyModel model_{body_, test::graphSurface(body_)};
  SymmetryGroup group_ = findSymmetry(body_);
  std::vector<RhythmMatch> all_;
  std::vector<Passage> passages_;
};

/// The same motion of a relabelled body; a reflection mirrors it in the plane x = 0 of the world.
RigidState relabelled(const RigidState& state, const Eigen::Matrix3d& element) {
  const bool improper = element.determinant() < 0;
  const Eigen::Matrix3d mirror = Eigen::Vector3d(improper ? -1 : 1, 1, 1).asDiagonal();
  RigidState seen = state;
  seen.position = mirror * state.position;
  seen.orientation =
      Eigen::Quaterniond(mirror * state.orientation.toRotationMatrix() * element.transpose());
  seen.velocity = mirror * state.velocity;
  seen.angularVelocity = (improper ? -1 : 1) * (mirror * state.angularVelocity);
  return seen;
}

TEST_F(AimedAt, WhatFollowedIsNearlyFree) {
  ASSERT_GT(passages_.size(), 200U);
  const std::vector<Eigen::Matrix3d> none = {Eigen::Matrix3d::Identity()};
  const AimedEvents events(database_, all_, none, body_.radius);
  for (const Passage& passage : passages_) {
    const auto aims = best(events, passage, database_.events());
    const auto own = std::find_if(aims.begin(), aims.end(),
                                  [&](const Aim& aim) { return aim.event == passage.next; });
    ASSERT_NE(own, aims.end());
    EXPECT_LT(own->cost, 1e-4);
    EXPECT_LE(aims.front().cost, own->cost);
  }
}

TEST_F(AimedAt, ARelabelledBodyFindsTheSame) {
  ASSERT_EQ(group_.order(), 48U);
  const AimedEvents events(database_, all_, group_.elements(), body_.radius);
  for (std::size_t p = 0; p < passages_.size(); p += 5) {
    const auto first = best(events, passages_[p]);
    ASSERT_EQ(first.size(), 1U);
    for (const std::size_t element : {1U, 7U, 23U, 24U, 35U, 47U}) {
      Passage seen = passages_[p];
      seen.before = relabelled(seen.before, group_.elements()[element]);
      seen.after = relabelled(seen.after, group_.elements()[element]);
      const auto again = best(events, seen);
      ASSERT_EQ(again.size(), 1U);
      EXPECT_EQ(again[0].event, first[0].event) << p << " " << element;
      EXPECT_NEAR(again[0].cost, first[0].cost, 1e-7);
      // Its key is the first one's, as the relabelled body sees it.
      const Eigen::Matrix3d& g = group_.elements()[element];
      const double sign = group_.isRotation(element) ? 1 : -1;
      EXPECT_LT((again[0].key.up - g * first[0].key.up).norm(), 1e-9);
      EXPECT_LT((again[0].key.velocity - g * first[0].key.velocity).norm(), 1e-9);
      EXPECT_LT((again[0].key.angularVelocity - sign * (g * first[0].key.angularVelocity)).norm(),
                1e-8);
    }
  }
}

TEST_F(AimedAt, SymmetryNeverCosts) {
  const std::vector<Eigen::Matrix3d> none = {Eigen::Matrix3d::Identity()};
  const AimedEvents alone(database_, all_, none, body_.radius);
  const AimedEvents events(database_, all_, group_.elements(), body_.radius);
  int cheaper = 0;
  for (std::size_t p = 0; p < passages_.size(); p += 5) {
    // What followed is not asked for, or it would win each time.
    Passage other = passages_[p];
    other.duration *= 1.1;
    const auto a = best(alone, other), b = best(events, other);
    ASSERT_FALSE(b.empty());
    if (a.empty()) continue;
    EXPECT_LE(b[0].cost, a[0].cost + 1e-12);
    cheaper += b[0].cost < a[0].cost;
  }
  EXPECT_GT(cheaper, 10);
}

TEST_F(AimedAt, FewAreTheBestOfManyAndNoneTwice) {
  const AimedEvents events(database_, all_, group_.elements(), body_.radius);
  for (std::size_t p = 0; p < passages_.size(); p += 25) {
    const auto many = best(events, passages_[p], 50), few = best(events, passages_[p], 5, 4);
    for (std::size_t i = 0; i < few.size(); ++i) {
      EXPECT_EQ(few[i].event, many[i].event);
      EXPECT_LT(few[i].cost, 4);
      for (std::size_t k = 0; k < i; ++k) EXPECT_NE(few[k].event, few[i].event);
    }
  }
}

/// Flights that are aimed at a pose come to it in time.
class AimedFlight : public testing::TestWithParam<std::size_t> {};

TEST_P(AimedFlight, ComesToThePose) {
  const test::Ground ground = test::grounds()[GetParam()];
  const BodyModel model(ground.body, ground.surface);
  RandomStream random(3, 3);
  int made = 0, tried = 0;
  for (const ContactEvent& event : test::firstContacts(ground, model, 60)) {
    const PlausibleRegion region(event.after.velocity - event.before.velocity,
                                 event.after.angularVelocity - event.before.angularVelocity,
                                 model.radius);
    const double duration = random.uniform(0.03, 0.2);
    const AimingFlight own = aimingFlight(model, event.after, region, duration);
    const Eigen::Vector3d up = (own.arrival.orientation.conjugate() * Eigen::Vector3d::UnitZ() +
                                test::randomVector(random, 0.15))
                                   .normalized();
    ++tried;
    const auto flight = aimFlight(model, event.after, region, duration, up);
    if (!flight) continue;
    const auto touch = firstTouch(model, flight->departure, duration + 1e-3);
    ASSERT_TRUE(touch.has_value());
    if (touch->time < duration - 1e-4) continue;  // something else touches earlier
    ++made;
    EXPECT_NEAR(touch->time, duration, 1e-7);
    const Eigen::Vector3d seen = touch->state.orientation.conjugate() * Eigen::Vector3d::UnitZ();
    EXPECT_LT((seen - up).norm(), 0.011);
    EXPECT_LT(tiltTo(touch->state.orientation, up).norm(), 0.011);
  }
  EXPECT_GT(3 * made, tried);
}

TEST_P(AimedFlight, FirstOrderTiltIsWhatASmallChangeDoes) {
  const test::Ground ground = test::grounds()[GetParam()];
  const BodyModel model(ground.body, ground.surface);
  for (const ContactEvent& event : test::firstContacts(ground, model, 30)) {
    const PlausibleRegion region(event.after.velocity - event.before.velocity,
                                 event.after.angularVelocity - event.before.angularVelocity,
                                 model.radius);
    const double duration = 0.05;
    const AimingFlight own = aimingFlight(model, event.after, region, duration);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-3;
      Coordinates y = Coordinates::Zero();
      y[3 + axis] = kStep;
      Eigen::Vector3d linear, angular;
      region.change(y, linear, angular);
      RigidState changed = event.after;
      changed.angularVelocity += angular;
      const AimingFlight other = aimingFlight(model, changed, region, duration);
      const Eigen::Vector3d tilt =
          tiltTo(own.arrival.orientation,
                 other.arrival.orientation.conjugate() * Eigen::Vector3d::UnitZ());
      const Eigen::Vector2d expected = kStep * own.tilting.col(axis);
      EXPECT_LT((tilt.head<2>() - expected).norm(), 0.02 * kStep * own.tilting.norm() + 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, AimedFlight, testing::Values(0, 1, 2));

}  // namespace
}  // namespace ifa
