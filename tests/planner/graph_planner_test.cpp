// SPDX-License-Identifier: Apache-2.0
// What a user may ask of the graph planner, and what it answers.
#include "planner/graph_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "audit/audit.h"
#include "base/parallel.h"
#include "motion/build_motion.h"
#include "planner/graph_plan_cases.h"
#include "planner/graph_search.h"
#include "planner/plan_difference.h"
#include "support/drop_database.h"

namespace ifa::test {
namespace {

using testing::HasSubstr;

class GraphPlannerTest : public testing::Test {
 protected:
  GraphPlannerTest()
      : drops_(graphDie(), graphDieSurface(), 800, 22), graph_(graphOf(drops_, graphDie())) {}

  [[nodiscard]] PlanRequest request(std::size_t events, bool terminal = false) const {
    return graphRequest(graphDie(), graphDieSurface(), graph_,
                        signaturesOf(graph_, 1, events, terminal, 3)[0]);
  }
  static std::vector<Plan> plans(const PlanRequest& request, const Progress& progress = {}) {
    return GraphPlanner(quickGraphSearch()).plan(request, progress).value();
  }
  static ErrorCode refusal(const PlanRequest& request, const Progress& progress = {}) {
    const auto made = GraphPlanner(quickGraphSearch()).plan(request, progress);
    EXPECT_FALSE(made.has_value());
    return made ? ErrorCode::kInternal : made.error().code;
  }
  static void expectMotion(const PlanRequest& request, const Plan& plan) {
    auto motion = buildMotion(request, plan, 0.3);
    ASSERT_TRUE(motion) << motion.error().text();
    motion->object.surface = graphDie().definition.defaultSurface;
    const AuditReport report = audit(*motion, graphDie());
    EXPECT_TRUE(report.passed()) << formatAudit(report);
  }

  DropDatabase drops_;
  ContactGraph graph_;
};

TEST_F(GraphPlannerTest, OneContactIsAnEventAndTheMotionThatComesToIt) {
  for (const bool terminal : {true, false}) {
    ContactSignature signature;
    signature.events = {{0, terminal ? 0.08 : 0.012, 1, 0.005, 1}};
    signature.terminal = terminal;
    PlanRequest asked = graphRequest(graphDie(), graphDieSurface(), graph_, signature);
    asked.settings.takes = 2;
    const std::vector<Plan> made = plans(asked);
    ASSERT_FALSE(made.empty());
    for (const Plan& plan : made) {
      EXPECT_TRUE(plan.solved);
      ASSERT_EQ(plan.contacts.size(), 1U);
      EXPECT_EQ(plan.contacts[0].event.terminal, terminal);
      expectMotion(asked, plan);
    }
    // No event of that kind sounds more like it.
    double best = 0;
    for (std::uint32_t id = 0; id < graph_.database().events(); ++id) {
      if (graph_.database().record(id).has(EventRecord::kTerminal) != terminal) continue;
      const HeardEvent heard = graph_.heard(id, 1);
      const double l = heard.duration - signature.events[0].duration;
      const double c = (heard.duration > 0 ? heard.centroid : 0) - 0.005;
      best = std::max(best, std::exp(-7000 * (l * l + c * c) / 6));
    }
    EXPECT_NEAR(made[0].score, best, 1e-6);
  }
}

TEST_F(GraphPlannerTest, TakesAreDifferentAndTheBestComesFirst) {
  PlanRequest asked = request(3);
  asked.settings.takes = 4;
  const std::vector<Plan> made = plans(asked);
  ASSERT_EQ(made.size(), 4U);
  for (std::size_t a = 0; a < made.size(); ++a) {
    EXPECT_TRUE(made[a].solved);
    expectMotion(asked, made[a]);
    for (std::size_t b = a + 1; b < made.size(); ++b) {
      EXPECT_GE(made[a].score, made[b].score);
      EXPECT_TRUE(differentTakes(made[a], made[b], asked.symmetry));
    }
  }
}

/// Direction of the body that points up after the last contact.
Eigen::Vector3d upAtRest(const Plan& plan) {
  const PlannedContact& last = plan.contacts.back();
  return last.placement.apply(last.event.after).orientation.conjugate() * Eigen::Vector3d::UnitZ();
}

TEST_F(GraphPlannerTest, LiesAsIsAsked) {
  int sameFace = 0, otherFaces = 0;
  for (const ContactSignature& signature : signaturesOf(graph_, 6, 2, true, 3)) {
    PlanRequest asked = graphRequest(graphDie(), graphDieSurface(), graph_, signature);
    asked.symmetry.clear();  // so that faces are told apart
    const Plan free = plans(asked).front();
    if (!free.solved) continue;
    // A cube's faces are its axes; it may still settle by some degrees.
    const Eigen::Vector3d lay = upAtRest(free).array().round();
    ASSERT_EQ(lay.norm(), 1);
    for (const Eigen::Vector3d& face : {lay, Eigen::Vector3d(-lay)}) {
      asked.orientations = {{1, face, Eigen::Vector3d::UnitZ()}};
      const Plan plan = plans(asked).front();
      EXPECT_TRUE(plan.solved || face != lay);
      if (!plan.solved) continue;
      ++(face == lay ? sameFace : otherFaces);
      expectMotion(asked, plan);
      EXPECT_GT(upAtRest(plan).dot(face), std::cos(4.1 * M_PI / 180));
      EXPECT_GE(plan.contacts.back().factors.o, 0.5);
    }
  }
  EXPECT_GE(sameFace, 2);
  EXPECT_GE(otherFaces, 1);
}

/// The paths that the search gives one after another, as far as it may ask.
std::vector<double> scoresOf(const PlanRequest& request) {
  PathConnector connector(request);
  GraphSearch search(request, quickGraphSearch(), connector, [] { return false; });
  std::vector<double> scores;
  const auto n = static_cast<double>(request.signature.events.size());
  while (const auto path = search.next()) {
    double total = path->sound.total();
    for (int level = 0; level < path->last(); ++level) {
      const GraphEdge& step = path->edges[static_cast<std::size_t>(level)];
      const auto& made =
          connector.edge(level, path->event(level), step.sibling, step.symmetry, step.time);
      total += made.logVelocity + made.logOrientation + made.logTimeWarp;
      total += step.weight.amplitude + step.weight.duration + step.weight.centroid;
    }
    scores.push_back(std::exp(total / (6 * n)));
  }
  return scores;
}

TEST_F(GraphPlannerTest, TheFirstPlanThatIsGoodEnoughEndsTheSearch) {
  PlanRequest asked = request(4);
  const std::vector<double> scores = scoresOf(asked);
  ASSERT_GT(scores.size(), 2U);
  const double best = *std::max_element(scores.begin(), scores.end());
  double last = 0;
  for (const double enough : {0.0, 0.3, 0.5 * (scores[0] + best), 1.0}) {
    asked.settings.earlyExit = enough;
    const Plan plan = plans(asked).at(0);
    const auto first =
        std::find_if(scores.begin(), scores.end(), [&](double score) { return score >= enough; });
    EXPECT_NEAR(plan.score, first == scores.end() ? best : *first, 1e-9) << enough;
    EXPECT_GE(plan.score, last);
    last = plan.score;
  }
  EXPECT_GT(last, 0.3);
}

void expectSamePlan(const Plan& a, const Plan& b) {
  EXPECT_EQ(a.solved, b.solved);
  EXPECT_EQ(a.failure, b.failure);
  EXPECT_EQ(a.score, b.score);
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    const PlannedContact &x = a.contacts[i], &y = b.contacts[i];
    EXPECT_EQ(x.source.simulation, y.source.simulation);
    EXPECT_EQ(x.source.event, y.source.event);
    EXPECT_EQ(x.time, y.time);
    EXPECT_EQ(x.bend, y.bend);
    EXPECT_EQ(x.arrivalBend, y.arrivalBend);
    EXPECT_EQ(x.velocityChange, y.velocityChange);
    EXPECT_EQ(x.angularVelocityChange, y.angularVelocityChange);
    EXPECT_EQ(x.arrivalChange, y.arrivalChange);
    EXPECT_EQ(x.arrivalAngularChange, y.arrivalAngularChange);
    EXPECT_EQ(x.source.symmetry, y.source.symmetry);
    EXPECT_EQ(x.placement.image.mirrored, y.placement.image.mirrored);
    EXPECT_EQ(x.placement.plane.x, y.placement.plane.x);
    EXPECT_EQ(x.placement.plane.y, y.placement.plane.y);
    EXPECT_EQ(x.placement.plane.halfCosine, y.placement.plane.halfCosine);
    EXPECT_EQ(x.placement.plane.halfSine, y.placement.plane.halfSine);
    EXPECT_EQ(x.event.after.position, y.event.after.position);
    EXPECT_EQ(x.event.after.velocity, y.event.after.velocity);
  }
}

TEST_F(GraphPlannerTest, TheSameRequestGivesTheSamePlansOverAnyThreads) {
  for (const std::size_t events : {4UL, 8UL}) {
    PlanRequest asked = request(events);
    asked.settings.takes = 2;
    const std::vector<Plan> truth = plans(asked);
    for (const int threads : {1, 2, 5}) {
      setThreadCount(threads);
      const ContactGraph again = graphOf(drops_, graphDie());
      asked.graph = &again;
      const std::vector<Plan> made = plans(asked);
      ASSERT_EQ(made.size(), truth.size());
      for (std::size_t i = 0; i < made.size(); ++i) expectSamePlan(made[i], truth[i]);
    }
    setThreadCount(0);
  }
}

TEST_F(GraphPlannerTest, RefusesWhatCannotBePlanned) {
  const PlanRequest good = request(3);
  PlanRequest none = good, empty = good, back = good, twice = good;
  none.graph = nullptr;
  EXPECT_EQ(refusal(none), ErrorCode::kUsage);
  empty.signature.events.clear();
  EXPECT_EQ(refusal(empty), ErrorCode::kBadInput);
  std::swap(back.signature.events[1], back.signature.events[2]);
  EXPECT_EQ(refusal(back), ErrorCode::kBadInput);
  twice.signature.events[2].time = twice.signature.events[1].time;
  EXPECT_EQ(refusal(twice), ErrorCode::kBadInput);
}

TEST_F(GraphPlannerTest, SaysWhichContactCannotBeMet) {
  PlanRequest asked = request(4);
  asked.signature.events[3].time = asked.signature.events[2].time + 3;
  const std::vector<Plan> made = plans(asked);
  ASSERT_EQ(made.size(), 1U);
  EXPECT_FALSE(made[0].solved);
  EXPECT_THAT(made[0].failure, HasSubstr("contact 4 at "));
  EXPECT_THAT(made[0].failure, HasSubstr("3000 ms after"));
  EXPECT_EQ(made[0].contacts.size(), 3U);
  const auto motion = buildMotion(asked, made[0], 0.3);
  ASSERT_TRUE(motion) << motion.error().text();
  EXPECT_FALSE(motion->success);

  asked.signature.events[1].time = asked.signature.events[0].time + 1e-7;
  const Plan second = plans(asked).at(0);
  EXPECT_THAT(second.failure, HasSubstr("contact 2 at 0.000 s"));
  EXPECT_TRUE(second.contacts.empty());
}

TEST_F(GraphPlannerTest, ATimeLimitCutsTheSearchOffAndIsReported) {
  PlanRequest asked = request(8, true);
  asked.settings.timeLimitSeconds = 1e-9;
  const Plan plan = plans(asked).at(0);
  EXPECT_TRUE(plan.timeLimitReached);
  EXPECT_FALSE(plan.solved);
  EXPECT_THAT(plan.failure, testing::StartsWith("the time limit was reached; contact "));
}

/// Asked to stop at once; and by what is reported, once there is a plan.
TEST_F(GraphPlannerTest, StopsWhenAsked) {
  PlanRequest asked = request(4);
  asked.settings.earlyExit = 1;
  std::atomic<bool> stop = true;
  EXPECT_EQ(refusal(asked, {nullptr, &stop}), ErrorCode::kInterrupted);
  stop = false;
  int begun = 0;
  const Progress progress{[&](std::string_view, double share) {
                            if (share == 0 && ++begun == 3) stop = true;
                          },
                          &stop};
  const std::vector<Plan> made = plans(asked, progress);
  EXPECT_TRUE(stop);
  EXPECT_TRUE(made.at(0).solved);
  EXPECT_FALSE(made[0].timeLimitReached);
}

}  // namespace
}  // namespace ifa::test
