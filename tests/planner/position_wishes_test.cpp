// SPDX-License-Identifier: Apache-2.0
#include "planner/position_wishes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/shooting_cases.h"
#include "planner/shooting_planner.h"

namespace ifa {
namespace {

using Eigen::Vector2d;

Plan planOf(const PlanRequest& request) {
  auto plans = ShootingPlanner(test::smallSearch()).plan(request, {});
  return plans ? plans->front() : Plan();
}

Vector2d placeOf(const PlannedContact& contact) {
  return contact.placement.apply(contact.event.before).position.head<2>();
}

TEST(PositionWishesTest, RegisterByTheFirstTwoPlaces) {
  PlanRequest request = test::requestFor(test::die());
  request.positions = {{0, {1, 1}}, {2, {1, 3}}, {3, {2, 3}}};
  const PositionWishes wishes(request);
  Registered registered;
  EXPECT_FALSE(wishes.place(0, registered, {{0, 0}, {0.3, 0.4}, 0.1}));
  EXPECT_EQ(wishes.meet(0, {0.3, 0.4}, registered), 0);
  EXPECT_EQ(wishes.meet(1, {9, 9}, registered), 0);
  // Two metres from the first, whichever way it goes; 10 cm too far costs 70.
  const auto second = wishes.place(2, registered, {{0, 0}, {1.3, 0.4}, 0.1});
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->isApprox(Vector2d(2.3, 0.4), 1e-12));
  EXPECT_NEAR(wishes.meet(2, {2.4, 0.4}, registered), -7000 * 0.01, 1e-6);
  // What is along x in the motion's frame is along y in the plane, so (2, 3) is to the right of it.
  const auto third = wishes.place(3, registered, {{0, 0}, {0, 0}, 0.1});
  ASSERT_TRUE(third);
  EXPECT_TRUE(third->isApprox(Vector2d(2.3, -0.6), 1e-12)) << third->transpose();
  EXPECT_NEAR(wishes.meet(3, {2.3, -0.6}, registered), 0, 1e-9);
}

// Where only a later contact has a place, a flight goes its part of the way there.
TEST(PositionWishesTest, AreApproachedFromAfar) {
  PlanRequest request = test::requestFor(test::die());
  request.signature = test::clicks(
      {{0, 0, 1, 0, 1}, {0.2, 0, 0.8, 0, 1}, {0.3, 0, 0.6, 0, 1}, {0.4, 0, 0.5, 0, 1}}, true);
  request.positions = {{0, {0, 0}}, {3, {0, 1}}};
  const PositionWishes wishes(request);
  Registered registered;
  EXPECT_EQ(wishes.meet(0, {2, 0}, registered), 0);
  const LevelFlight flight = {{2, 0}, {2.1, 0}, 0.2};
  const auto resting = wishes.place(1, registered, flight);  // half of the time
  ASSERT_TRUE(resting);
  EXPECT_TRUE(resting->isApprox(Vector2d(2.75, 0), 1e-12)) << resting->transpose();
  request.signature.terminal = false;
  const auto passing = wishes.place(1, registered, flight);
  ASSERT_TRUE(passing);
  EXPECT_TRUE(passing->isApprox(Vector2d(2.5, 0), 1e-12)) << passing->transpose();
}

TEST(PositionWishesTest, OfTheLastContactIsReached) {
  PlanRequest request = test::requestFor(test::die());
  request.signature = test::clicks(
      {{0, 0, 1, 0, 1}, {0.25, 0, 0.8, 0, 1}, {0.45, 0, 0.6, 0, 1}, {0.5, 0, 0.4, 0, 1}}, false);
  for (const double way : {0.1, 0.25, 0.6}) {
    request.positions = {{0, {0, 0}}, {3, {way, 0}}};
    const Plan plan = planOf(request);
    ASSERT_TRUE(plan.solved) << plan.failure;
    EXPECT_NEAR(placeOf(plan.contacts[3]).x(), way, 0.015);
    EXPECT_GT(plan.score, 0.8);
  }
}

TEST(PositionWishesTest, AreWhereAnotherMotionWas) {
  PlanRequest request = test::requestFor(test::die());
  request.signature = test::clicks(
      {{0, 0, 1, 0, 1}, {0.25, 0, 0.8, 0, 1}, {0.45, 0, 0.6, 0, 1}, {0.6, 0, 0.5, 0, 1}}, false);
  const Plan free = planOf(request);
  ASSERT_TRUE(free.solved) << free.failure;
  PlanarTransform elsewhere{std::cos(0.4), std::sin(0.4), 0.7, -0.2};
  for (const PlannedContact& contact : free.contacts) {
    RigidState state;
    state.position.head<2>() = placeOf(contact);
    request.positions.push_back(
        {static_cast<std::size_t>(contact.target), elsewhere.apply(state).position.head<2>()});
  }
  request.settings.seed = 5;
  const Plan plan = planOf(request);
  ASSERT_TRUE(plan.solved) << plan.failure;
  for (std::size_t k = 0; k < plan.contacts.size(); ++k) {
    const double off = (placeOf(plan.contacts[k]) - request.positions[k].place).norm();
    EXPECT_LT(off, k == 0 ? 1e-12 : 0.01) << k;
    EXPECT_NEAR(plan.contacts[k].factors.p, std::exp(-7000 * off * off), 1e-6);
  }
  EXPECT_GT(plan.score, 0.8);
}

/// Farthest that a contact begins from its place, m.
double mostMissed(const Plan& plan, const PlanRequest& request) {
  double most = 0;
  for (const PlannedContact& contact : plan.contacts) {
    const Vector2d& place = request.positions[static_cast<std::size_t>(contact.target)].place;
    most = std::max(most, (placeOf(contact) - place).norm());
  }
  return most;
}

TEST(PositionWishesTest, AreLookedForOnWhereOneIsMissed) {
  PlanRequest request = test::requestFor(test::die());
  request.signature = test::signatures(test::die(), 1, 8, 12)[0];
  for (std::size_t k = 0; k < request.signature.events.size(); ++k) {
    const double zigzag = k % 2 == 0 ? 0 : 0.05;
    request.positions.push_back({k, {0.5 * request.signature.events[k].time, zigzag}});
  }
  request.settings.seed = 1;
  ShootingPlannerSettings settings = test::smallSearch();
  settings.passes = 1;
  const auto first = ShootingPlanner(settings).plan(request, {});
  settings.passes = 6;
  const auto best = ShootingPlanner(settings).plan(request, {});
  ASSERT_TRUE(first && first->front().solved);
  ASSERT_TRUE(best && best->front().solved);
  EXPECT_GT(mostMissed(first->front(), request), 0.06);
  EXPECT_LT(mostMissed(best->front(), request), 0.05);
}

TEST(PositionWishesTest, OfOneContactCostNothing) {
  PlanRequest request = test::requestFor(test::die());
  request.signature =
      test::clicks({{0, 0, 1, 0, 1}, {0.25, 0, 0.8, 0, 1}, {0.45, 0, 0.6, 0, 1}}, false);
  const Plan free = planOf(request);
  request.positions = {{2, {0.5, -3}}};
  const Plan plan = planOf(request);
  ASSERT_TRUE(plan.solved) << plan.failure;
  EXPECT_EQ(plan.score, free.score);
  EXPECT_TRUE(placeOf(plan.contacts[2]).isApprox(Vector2d(0.5, -3), 1e-12));
}

}  // namespace
}  // namespace ifa
