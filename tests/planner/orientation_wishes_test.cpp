// SPDX-License-Identifier: Apache-2.0
#include "planner/orientation_wishes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "body/object_file.h"
#include "body/symmetry.h"
#include "planner/shooting_cases.h"
#include "planner/shooting_planner.h"

namespace ifa {
namespace {

constexpr double kFourDegrees = 0.0699;

/// The rhythm of a drop of its own, to rest.
PlanRequest restingRequest(const Body& body) {
  PlanRequest request = test::requestFor(body);
  request.signature = test::signatures(body, 1, 3, 8)[0];
  request.signature.terminal = true;
  return request;
}

std::size_t lastOf(const PlanRequest& request) { return request.signature.events.size() - 1; }

Plan planOf(const PlanRequest& request,
            const ShootingPlannerSettings& settings = test::smallSearch()) {
  auto plans = ShootingPlanner(settings).plan(request, {});
  return plans ? plans->front() : Plan();
}

/// Where `direction` of the body points at the end.
Eigen::Vector3d shownAtRest(const Plan& plan, const Eigen::Vector3d& direction) {
  const PlannedContact& last = plan.contacts.back();
  return last.placement.apply(last.event.after).orientation * direction;
}

TEST(OrientationWishesTest, ShowAnyFaceOfADieAtNoPrice) {
  const Body& die = test::die();
  PlanRequest request = restingRequest(die);
  const SymmetryGroup group = findSymmetry(die);
  request.symmetry = group.elements();
  const Plan free = planOf(request);
  ASSERT_TRUE(free.solved) << free.failure;
  for (const auto& [name, direction] : die.definition.faces) {
    const Eigen::Vector3d face = die.bodyFromPrincipal.transpose() * direction;
    request.orientations = {{lastOf(request), face, Eigen::Vector3d::UnitZ()}};
    const Plan plan = planOf(request);
    ASSERT_TRUE(plan.solved) << name << ": " << plan.failure;
    EXPECT_NEAR(std::acos(shownAtRest(plan, face).z()), 0, kFourDegrees) << name;
    EXPECT_GT(plan.contacts.back().factors.o, 0.5) << name;
    EXPECT_NEAR(plan.score, free.score, 0.02) << name;
  }
}

TEST(OrientationWishesTest, TurnTheWholeMotionWhereTheyAreLevel) {
  const Body& die = test::die();
  PlanRequest request = restingRequest(die);
  const SymmetryGroup group = findSymmetry(die);
  request.symmetry = group.elements();
  const Eigen::Vector3d six = die.bodyFromPrincipal.transpose() * die.definition.faces.at("6");
  const Eigen::Vector3d two = die.bodyFromPrincipal.transpose() * die.definition.faces.at("2");
  const Eigen::Vector3d there = Eigen::Vector3d(3, 4, 0).normalized();
  request.orientations = {{lastOf(request), six, Eigen::Vector3d::UnitZ()},
                          {lastOf(request), two, there}};
  const Plan plan = planOf(request);
  ASSERT_TRUE(plan.solved) << plan.failure;
  EXPECT_GT(shownAtRest(plan, six).z(), std::cos(kFourDegrees));
  EXPECT_GT(shownAtRest(plan, two).dot(there), std::cos(kFourDegrees));
}

TEST(OrientationWishesTest, AreSearchedForWhereTheBodyHasNoSuchSymmetry) {
  const Body eraser = loadObject("Eraser").value();
  PlanRequest request = restingRequest(eraser);
  // Without its group, one of the two broad faces must come to lie below.
  for (const double side : {1.0, -1.0}) {
    Eigen::Index thin = 0;
    eraser.principalMoments.maxCoeff(&thin);
    const Eigen::Vector3d broad = side * Eigen::Vector3d::Unit(thin);
    request.orientations = {{lastOf(request), broad, Eigen::Vector3d::UnitZ()}};
    const Plan plan = planOf(request, {});
    ASSERT_TRUE(plan.solved) << plan.failure;
    EXPECT_GT(shownAtRest(plan, broad).z(), std::cos(kFourDegrees));
  }
}

TEST(OrientationWishesTest, HoldInTheMiddleToo) {
  PlanRequest request = restingRequest(test::die());
  const SymmetryGroup group = findSymmetry(test::die());
  request.symmetry = group.elements();
  const Eigen::Vector3d corner = Eigen::Vector3d(1, 1, 1).normalized();
  request.orientations = {{1, corner, -Eigen::Vector3d::UnitZ()}};
  const Plan plan = planOf(request);
  ASSERT_TRUE(plan.solved) << plan.failure;
  const PlannedContact& second = plan.contacts[1];
  const Eigen::Vector3d shown = second.placement.apply(second.event.before).orientation * corner;
  EXPECT_LT(shown.z(), -std::cos(kFourDegrees));
  EXPECT_NEAR(second.factors.o, std::exp(-140 * std::pow(std::acos(-shown.z()), 2)), 1e-6);
}

TEST(OrientationWishesTest, ABrickTipsOverOntoItsBaseWhereItLandsDead) {
  // It tips over from an edge in silence. With the restitution of the surface it would clatter on
  // its base, but not on its side, for which this was heard.
  const Body brick = loadObject("Lego2x2").value();
  PlanRequest request = test::requestFor(brick);
  const std::vector<SignatureEvent> heard = {
      {0, 0, 1, 0},           {0.2541, 0.0111, 0.499, 0.0031}, {0.3681, 0, 0.205, 0},
      {0.4280, 0, 0.093, 0},  {0.4596, 0, 0.1185, 0},          {0.4981, 0, 0.1167, 0},
      {0.5259, 0, 0.051, 0},  {0.5523, 0, 0.0849, 0},          {0.5851, 0, 0.0577, 0},
      {0.7987, 0, 0.0262, 0},
  };
  request.signature = test::clicks(heard, true);
  request.settings.seed = 3;  // a pass is enough
  const Eigen::Vector3d studs =
      brick.bodyFromPrincipal.transpose() * brick.definition.faces.at("studs");
  request.orientations = {{lastOf(request), studs, Eigen::Vector3d::UnitZ()}};
  const Plan plan = planOf(request, {});
  ASSERT_TRUE(plan.solved) << plan.failure;
  EXPECT_GT(shownAtRest(plan, studs).z(), std::cos(kFourDegrees));
  EXPECT_LT(plan.contacts.back().restitution, request.surface.restitution - 0.1);
  EXPECT_LT(plan.bendMax, 1);
}

TEST(OrientationWishesTest, SayWhenNothingLiesSo) {
  PlanRequest request = restingRequest(test::die());
  // A die does not rest on a corner.
  request.orientations = {
      {lastOf(request), Eigen::Vector3d(1, 1, 1).normalized(), Eigen::Vector3d::UnitZ()}};
  const Plan plan = planOf(request);
  EXPECT_FALSE(plan.solved);
  EXPECT_THAT(plan.failure, testing::HasSubstr("--orient"));
}

}  // namespace
}  // namespace ifa
