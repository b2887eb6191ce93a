// SPDX-License-Identifier: Apache-2.0
// The hybrid planner end to end, with small budgets.
#include <gtest/gtest.h>

#include <array>
#include <atomic>

#include "base/parallel.h"
#include "body/symmetry.h"
#include "dynamics/energy.h"
#include "graph/edge_weight.h"
#include "planner/bodies.h"
#include "planner/flight_timing.h"
#include "planner/graph_plan_cases.h"
#include "planner/shooting_cases.h"
#include "planner/shooting_planner.h"
#include "support/drop_database.h"

namespace ifa {
namespace {

/// A tenth of the usual width.
ShootingPlannerSettings smallHybrid() {
  ShootingPlannerSettings settings = test::smallSearch();
  settings.aimedEvents = 150;
  settings.aimedEndings = 500;
  settings.aimedRoots = 40;
  settings.aimedBeam = 20;
  return settings;
}

class HybridPlanner : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Body& body = test::die();
    drops_ = new test::DropDatabase(
        body, body.definition.surfaces.at(body.definition.defaultSurface), 400, 3);
    database_ = new EventDatabase(drops_->open());
  }
  static void TearDownTestSuite() {
    delete database_;
    delete drops_;
  }

  [[nodiscard]] static PlanRequest request(const ContactSignature& signature) {
    PlanRequest request = test::requestFor(test::die());
    request.signature = signature;
    request.database = database_;
    return request;
  }
  [[nodiscard]] static std::vector<Plan> plans(const PlanRequest& request,
                                               const ShootingPlannerSettings& settings) {
    const auto found = ShootingPlanner(settings).plan(request, {});
    EXPECT_TRUE(found.has_value());
    return found.value_or(std::vector<Plan>(1));
  }

  static inline test::DropDatabase* drops_ = nullptr;
  static inline EventDatabase* database_ = nullptr;
};

/// The state that the contact makes of the arriving one, and the energy that it came with.
double arrivalEnergy(const BodyModel& model, const PlannedContact& contact) {
  RigidState state = contact.event.before;
  state.velocity -= contact.arrivalChange;
  state.angularVelocity -= contact.arrivalAngularChange;
  return totalEnergy(model, state);
}

/// What the audit asks of a transition, by itself.
void expectSoundTransitions(const PlanRequest& request, const Plan& plan) {
  const BodyModel model(*request.body, request.surface);
  for (std::size_t k = 0; k < plan.contacts.size(); ++k) {
    const PlannedContact& contact = plan.contacts[k];
    EXPECT_LE(contact.arrivalBend, request.settings.bendCap);
    EXPECT_NEAR(contact.factors.v,
                std::exp(-contact.bend * contact.bend - contact.arrivalBend * contact.arrivalBend),
                1e-12);
    const double energy = arrivalEnergy(model, contact);
    EXPECT_LE(totalEnergy(model, contact.event.after), energy * (1 + 1e-12)) << k;
    if (k + 1 == plan.contacts.size()) continue;
    RigidState departure = contact.event.after;
    departure.velocity += contact.velocityChange;
    departure.angularVelocity += contact.angularVelocityChange;
    EXPECT_LE(totalEnergy(model, departure), energy * (1 + 1e-12)) << k;
    // The flight leads to the pose of the next contact and to its velocities, less what it makes
    // up.
    const PlannedContact& next = plan.contacts[k + 1];
    if (next.arrival != Arrival::kFlight) continue;
    const auto touch = firstTouch(model, departure, 10);
    ASSERT_TRUE(touch.has_value());
    EXPECT_LT((touch->state.position - next.event.before.position).norm(), 1e-9);
    EXPECT_LT((touch->state.velocity + next.arrivalChange - next.event.before.velocity).norm(),
              1e-9);
  }
}

TEST_F(HybridPlanner, SolvesDropsWithSoundTransitions) {
  int transitions = 0, jumps = 0, solved = 0;
  for (const ContactSignature& signature : test::signatures(test::die(), 6, 5, 12)) {
    const PlanRequest asked = request(signature);
    const Plan plan = plans(asked, smallHybrid())[0];
    solved += plan.solved;
    expectSoundTransitions(asked, plan);
    for (const PlannedContact& contact : plan.contacts) {
      transitions += contact.source.kind == SourceKind::kDatabase;
      jumps += contact.arrivalBend > 0;
    }
  }
  EXPECT_GE(solved, 5);
  EXPECT_GT(transitions, 0);
  RecordProperty("jumps", jumps);
}

/// With nothing but transitions to choose from, the sound of events in a row leads from each to the
/// next one, and the last one closes the path.
TEST_F(HybridPlanner, TransitionsAloneRetraceADrop) {
  ShootingPlannerSettings settings = smallHybrid();
  settings.children = 0;
  settings.firstContacts = 1;
  settings.lateContacts = 0;
  settings.silentBeam = 0;
  constexpr std::size_t kEvents = 3;
  int tried = 0, retraced = 0;
  RandomStream random(1, 1);
  const ContactGraph graph = test::graphOf(*drops_, test::die());
  for (std::size_t first = 0; first + kEvents <= database_->events() && tried < 8; ++first) {
    const auto signature = test::signatureFrom(graph, first, kEvents, {0, 0}, random);
    if (!signature || !signature->terminal || !isLeftByFlight(database_->flags(), first) ||
        !isLeftByFlight(database_->flags(), first + 1)) {
      continue;
    }
    ++tried;
    const PlanRequest asked = request(*signature);
    const Plan plan = plans(asked, settings)[0];
    expectSoundTransitions(asked, plan);
    if (!plan.solved) continue;
    for (const PlannedContact& contact : plan.contacts) {
      EXPECT_EQ(contact.source.kind, SourceKind::kDatabase);
    }
    retraced += plan.score > 0.97;
  }
  EXPECT_GT(tried, 3);
  EXPECT_GE(retraced, tried - 1);
}

TEST_F(HybridPlanner, EventsAreTheirOwnImagesOnlyWhereSymmetryIsOff) {
  ShootingPlannerSettings settings = smallHybrid();
  settings.children = 0;  // so that there are transitions
  const SymmetryGroup group = findSymmetry(test::die());
  std::array<int, 2> images{};
  for (const ContactSignature& signature : test::signatures(test::die(), 6, 3, 6)) {
    for (const bool symmetry : {false, true}) {
      PlanRequest asked = request(signature);
      asked.symmetry = group.elements();
      asked.settings.symmetry = symmetry;
      const Plan plan = plans(asked, settings)[0];
      for (const PlannedContact& contact : plan.contacts) {
        images.at(symmetry ? 1 : 0) += contact.source.symmetry != 0;
      }
    }
  }
  EXPECT_EQ(images[0], 0);
  EXPECT_GT(images[1], 0);
}

TEST_F(HybridPlanner, SameWhateverTheThreads) {
  const PlanRequest asked = request(test::signatures(test::die(), 1, 6, 9)[0]);
  setThreadCount(1);
  const Plan one = plans(asked, smallHybrid())[0];
  setThreadCount(3);
  const Plan three = plans(asked, smallHybrid())[0];
  setThreadCount(0);
  EXPECT_EQ(one.score, three.score);
  ASSERT_EQ(one.contacts.size(), three.contacts.size());
  for (std::size_t k = 0; k < one.contacts.size(); ++k) {
    EXPECT_TRUE(test::sameBits(one.contacts[k].event.before, three.contacts[k].event.before));
    EXPECT_TRUE(test::sameBits(one.contacts[k].event.after, three.contacts[k].event.after));
  }
}

TEST_F(HybridPlanner, NeedsADatabase) {
  PlanRequest asked = request(test::signatures(test::die(), 1, 4, 7)[0]);
  asked.database = nullptr;
  const auto found = ShootingPlanner(smallHybrid()).plan(asked, {});
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().code, ErrorCode::kUsage);
}

TEST_F(HybridPlanner, AskedForAnotherPlanItTakesTheNextBest) {
  PlanRequest asked = request(test::signatures(test::die(), 1, 4, 7)[0]);
  const Plan first = plans(asked, smallHybrid())[0];
  ASSERT_TRUE(first.solved);
  std::atomic<int> calls = 0;
  asked.accepts = [&](const PlanRequest&, const Plan& plan) {
    ++calls;
    return plan.score < first.score;
  };
  const Plan second = plans(asked, smallHybrid())[0];
  EXPECT_TRUE(second.solved);
  EXPECT_LT(second.score, first.score);
  EXPECT_GE(calls, 2);
  asked.accepts = [](const PlanRequest&, const Plan&) { return false; };
  EXPECT_FALSE(plans(asked, smallHybrid())[0].solved);
}

}  // namespace
}  // namespace ifa
