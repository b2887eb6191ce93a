// SPDX-License-Identifier: Apache-2.0
// Takes made of one motion by landing elsewhere.
#include "planner/moved_landings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/energy.h"
#include "planner/shooting_cases.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using test::clicks;

/// How many landings of a plan can be moved.
std::size_t movable(const ShootingProblem& problem, const Plan& plan) {
  const MovedLandings landings(problem, plan);
  std::size_t count = 0;
  for (const MovedLanding& landing : landings.proposals()) count += landings.moved(landing) ? 1 : 0;
  return count;
}

/// Five clicks that a die makes without effort, and a motion for them that has some energy to
/// spare.
class MovedLandingsTest : public testing::Test {
 protected:
  MovedLandingsTest() : request_(test::requestFor(test::die())), settings_(test::smallSearch()) {
    request_.signature = clicks({{0, 0, 1, 0, 1},
                                 {0.28, 0, 0.8, 0, 1},
                                 {0.5, 0, 0.6, 0, 1},
                                 {0.66, 0, 0.5, 0, 1},
                                 {0.78, 0, 0.4, 0, 1}},
                                false);
    const ShootingProblem problem(request_, settings_);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      request_.settings.seed = seed;
      auto plans = ShootingPlanner(settings_).plan(request_, {});
      if (!plans || !plans->front().solved) continue;
      plan_ = plans->front();
      if (movable(problem, plan_) > 3) return;
    }
  }
  void SetUp() override { ASSERT_TRUE(plan_.solved) << plan_.failure; }

  /// Where the flight out of contact k comes to, and how fast, by the plan's own numbers.
  [[nodiscard]] static RigidState flown(const Plan& plan, std::size_t k) {
    const PlannedContact& from = plan.contacts[k];
    RigidState state = from.event.after;
    state.velocity += from.velocityChange;
    const PlannedContact& to = plan.contacts[k + 1];
    const double time = (to.time - from.time - from.event.end) / to.retiming;
    state = from.placement.apply(state);
    state.position += time * state.velocity - Vector3d(0, 0, 0.5 * kGravity * time * time);
    state.velocity.z() -= kGravity * time;
    return state;
  }

  PlanRequest request_;
  ShootingPlannerSettings settings_;
  Plan plan_;
};

/// The plan, its flights shown slower than they are, or faster.
Plan retimed(Plan plan, double by) {
  double later = 0;
  for (std::size_t k = 1; k < plan.contacts.size(); ++k) {
    const PlannedContact& from = plan.contacts[k - 1];
    PlannedContact& to = plan.contacts[k];
    to.time += later;
    const double gap = to.time - from.time - from.event.end;
    to.time += (by - 1) * gap;
    later += (by - 1) * gap;
    to.retiming = by;
  }
  return plan;
}

class MovedFlights : public MovedLandingsTest, public testing::WithParamInterface<double> {};

TEST_P(MovedFlights, EndWhereTheNextContactBegins) {
  const ShootingProblem problem(request_, settings_);
  const MovedLandings landings(problem, retimed(plan_, GetParam()));
  int moved = 0;
  for (const MovedLanding& landing : landings.proposals()) {
    const auto plan = landings.moved(landing);
    if (!plan) continue;
    ++moved;
    for (std::size_t k = 0; k + 1 < plan->contacts.size(); ++k) {
      const PlannedContact& next = plan->contacts[k + 1];
      if (next.arrival != Arrival::kFlight) continue;
      RigidState arrival = next.event.before;
      arrival.velocity -= next.arrivalChange;
      arrival = next.placement.apply(arrival);
      const RigidState flight = flown(*plan, k);
      EXPECT_LT((flight.position - arrival.position).norm(), 1e-9);
      EXPECT_LT((flight.velocity - arrival.velocity).norm(), 1e-9);
    }
  }
  EXPECT_GT(moved, 3);
}

INSTANTIATE_TEST_SUITE_P(Retimed, MovedFlights, testing::Values(1.0, 1.2, 0.8));

TEST_F(MovedLandingsTest, ContactsStayAsTheyWereAndLieElsewhere) {
  const ShootingProblem problem(request_, settings_);
  const MovedLandings landings(problem, plan_);
  int different = 0;
  for (const MovedLanding& landing : landings.proposals()) {
    const auto plan = landings.moved(landing);
    if (!plan) continue;
    ASSERT_EQ(plan->contacts.size(), plan_.contacts.size());
    for (std::size_t k = 0; k < plan_.contacts.size(); ++k) {
      const PlannedContact &was = plan_.contacts[k], &is = plan->contacts[k];
      EXPECT_EQ(is.time, was.time);
      EXPECT_EQ(is.event.before.velocity, was.event.before.velocity);
      EXPECT_EQ(is.event.after.position, was.event.after.position);
      EXPECT_EQ(is.angularVelocityChange, was.angularVelocityChange);
      EXPECT_EQ(is.factors.a, was.factors.a);
    }
    different += differentTakes(*plan, plan_) ? 1 : 0;
  }
  EXPECT_GT(different, 3);
}

TEST_F(MovedLandingsTest, WhatItCostsIsTold) {
  const ShootingProblem problem(request_, settings_);
  const MovedLandings landings(problem, plan_);
  for (const MovedLanding& landing : landings.proposals()) {
    const auto plan = landings.moved(landing);
    if (!plan) continue;
    EXPECT_FALSE(plan->solved) << "nobody has audited it yet";
    double all = 1, velocity = 1, worth = 0;
    for (const PlannedContact& contact : plan->contacts) {
      const ContactFactors& f = contact.factors;
      EXPECT_NEAR(f.v, std::exp(logVelocity(contact.bend) + logVelocity(contact.arrivalBend)),
                  1e-12);
      EXPECT_LE(std::max(contact.bend, contact.arrivalBend), request_.settings.bendCap);
      all *= f.v * f.a * f.l * f.c;
      velocity *= f.v;
      for (const double bend : {contact.bend, contact.arrivalBend}) {
        worth -= settings_.bendAversion * std::pow(std::max(0.0, bend - settings_.largeBend), 2);
      }
    }
    const auto n = static_cast<double>(plan->contacts.size());
    EXPECT_NEAR(plan->score, std::pow(all, 1 / (6 * n)), 1e-9);
    EXPECT_NEAR(plan->meanFv, std::pow(velocity, 1 / n), 1e-9);
    EXPECT_NEAR(plan->worth, std::log(all) + worth, 1e-6);
  }
}

TEST_F(MovedLandingsTest, NoContactGivesEnergy) {
  const ShootingProblem problem(request_, settings_);
  const MovedLandings landings(problem, plan_);
  for (const MovedLanding& landing : landings.proposals()) {
    const auto plan = landings.moved(landing);
    if (!plan) continue;
    for (const PlannedContact& contact : plan->contacts) {
      RigidState arrival = contact.event.before, departure = contact.event.after;
      arrival.velocity -= contact.arrivalChange;
      departure.velocity += contact.velocityChange;
      departure.angularVelocity += contact.angularVelocityChange;
      const double energy = totalEnergy(problem.model, arrival) * (1 + 1e-12);
      EXPECT_LE(totalEnergy(problem.model, departure), energy);
      EXPECT_LE(totalEnergy(problem.model, contact.event.after), energy);
    }
  }
}

TEST_F(MovedLandingsTest, OneContactHasNoFlightToChange) {
  const ShootingProblem problem(request_, settings_);
  Plan one = plan_;
  one.contacts.resize(1);
  EXPECT_TRUE(MovedLandings(problem, one).proposals().empty());
}

}  // namespace
}  // namespace ifa
