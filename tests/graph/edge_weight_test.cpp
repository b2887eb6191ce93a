// SPDX-License-Identifier: Apache-2.0
// The oracle puts equations 3 to 11 together from states in the world, by connections.
#include "graph/edge_weight.h"

#include <map>

#include "dynamics/energy.h"
#include "graph/graph_cases.h"

namespace ifa::test {
namespace {

class EdgeWeightTest : public testing::Test {
 protected:
  static const Body& body() {
    static const Body body = makeBoxBody({0.03, 0.02, 0.012}, 0.02);
    return body;
  }
  static const DropDatabase& drops() {
    static const DropDatabase drops(body(), 60, 3);
    return drops;
  }
  static const std::vector<Question>& asked() {
    static const std::vector<Question> all = questions(DropDatabase(body(), 20, 4), 40);
    return all;
  }

  /// By another way, in double precision.
  static EdgeWeight oracle(const ContactGraph& graph, const Question& question, std::uint32_t j) {
    const auto [source, target] = question;
    const GraphSettings& s = graph.settings();
    EdgeWeight weight;
    const auto refuse = [&](EdgeRefusal why) {
      weight.refusal = why;
      return weight;
    };
    const EventRecord record = graph.database().record(j);
    if (!record.has(EventRecord::kFollowed)) return refuse(EdgeRefusal::kNotFlight);
    const auto [first, second] = graph.passage(j);
    ConnectionSettings by;
    by.kind = s.connection;
    by.registerAt = RegisterAt::kDeparture;
    by.depth = 1;               // edges do not look at the ground,
    by.shooting.mostSteps = 0;  // and the spin is left until a path is chosen
    ContactEvent from;
    from.before = source.before;
    from.after = source.after;
    const BodyModel model(body(), graphSurface(body()));
    const ConnectionEnds ends = connectionEnds(from, first, second);
    const Connection made = connect(model, ends, target.time, by);
    if (made.failure == ConnectionFailure::kNotFlight) return refuse(EdgeRefusal::kNotFlight);
    if (second.terminal != target.terminal) return refuse(EdgeRefusal::kEnd);
    if (made.failure == ConnectionFailure::kTimeWarp) return refuse(EdgeRefusal::kTime);
    if (made.arrival.velocity.z() > 0 && second.before.velocity.z() <= 0) {
      return refuse(EdgeRefusal::kRising);
    }
    const RigidState laid = made.registration.transform.apply(first.after);
    RigidState leaving = source.after;
    leaving.velocity = made.departure.velocity;
    leaving.angularVelocity = laid.orientation.conjugate() * laid.angularVelocity;
    leaving.angularVelocity = leaving.orientation * leaving.angularVelocity;
    if (!energyAllows(totalEnergy(model, source.before), totalEnergy(model, leaving),
                      s.energyGain)) {
      return refuse(EdgeRefusal::kEnergy);
    }
    const bool printed = s.velocityReference == VelocityReference::kPrinted;
    const PlausibleRegion region(source.after.velocity - source.before.velocity,
                                 source.after.angularVelocity - source.before.angularVelocity,
                                 body().radius);
    weight.velocity =
        -std::pow(region.bend(leaving.velocity - (printed ? laid.velocity : source.after.velocity),
                              source.after.angularVelocity - laid.angularVelocity),
                  2);
    const double angle = angleBetween(planarKey(source.after), planarKey(first.after));
    weight.orientation = logOrientation(angle, made.time.flightTime);
    weight.timeWarp = logTimeWarp(target.time, ends.time);
    const HeardEvent heard = {second.amplitude / target.firstAmplitude,
                              second.filteredDuration(0.01), second.centroid};
    weight.amplitude = logAmplitude(target.heard, heard);
    weight.duration = logDuration(target.heard, heard);
    weight.centroid = logCentroid(target.heard, heard);
    if (weight.velocity < s.leastVelocity) return refuse(EdgeRefusal::kVelocity);
    if (weight.orientation < s.leastOrientation) return refuse(EdgeRefusal::kOrientation);
    return weight;
  }

  static void expectOracle(const GraphSettings& settings) {
    const ContactGraph graph = graphOf(drops(), body(), settings);
    std::map<EdgeRefusal, int> seen;
    for (const Question& question : asked()) {
      for (std::uint32_t j = 0; j < graph.database().events(); ++j) {
        const EdgeWeight weight = graph.edgeWeight(question.source, question.target, j);
        const EdgeWeight other = oracle(graph, question, j);
        ++seen[weight.refusal];
        ASSERT_EQ(weight.refusal, other.refusal) << j;
        if (!weight.exists()) continue;
        // Gaps are taken from clock times in the oracle, so a few bits less are left.
        EXPECT_NEAR(weight.velocity, other.velocity, 1e-8 * (1 - other.velocity));
        EXPECT_NEAR(weight.orientation, other.orientation, 1e-8);
        EXPECT_NEAR(weight.timeWarp, other.timeWarp, 1e-8 * (1 - other.timeWarp));
        EXPECT_NEAR(weight.amplitude, other.amplitude, 1e-12);
        EXPECT_NEAR(weight.duration, other.duration, 1e-12 * (1 - other.duration));
        EXPECT_NEAR(weight.centroid, other.centroid, 1e-12 * (1 - other.centroid));
      }
    }
    for (const EdgeRefusal kind : {EdgeRefusal::kNone, EdgeRefusal::kNotFlight, EdgeRefusal::kEnd,
                                   EdgeRefusal::kEnergy, EdgeRefusal::kVelocity}) {
      EXPECT_GT(seen[kind], 0) << static_cast<int>(kind);
    }
  }
};

TEST_F(EdgeWeightTest, IsWhatTheStatesGive) {
  GraphSettings wide;
  wide.leastVelocity = -300;
  expectOracle(wide);
}

TEST_F(EdgeWeightTest, IsWhatTheStatesGiveWarped) {
  GraphSettings wide;
  wide.leastVelocity = -300;
  wide.connection = ConnectionKind::kBlend;
  expectOracle(wide);
}

TEST_F(EdgeWeightTest, IsWhatTheStatesGiveAgainstThePrintedReference) {
  GraphSettings wide;
  wide.leastVelocity = -300;
  wide.velocityReference = VelocityReference::kPrinted;
  wide.connection = ConnectionKind::kBlend;
  expectOracle(wide);
}

TEST_F(EdgeWeightTest, PassageIsAFlight) {
  const ContactGraph graph = graphOf(drops(), body());
  int flights = 0;
  for (std::uint32_t j = 0; j + 1 < graph.database().events(); ++j) {
    const EventRecord record = graph.database().record(j);
    const bool flies = record.has(EventRecord::kFollowed) &&
                       !record.has(EventRecord::kSilentPassage) &&
                       !record.has(EventRecord::kTouchingAfter);
    if (!flies) continue;
    const auto [first, second] = graph.passage(j);
    const double time = second.start - first.end;
    const Eigen::Vector3d fall(0, 0, -kGravity / 2 * time * time);
    EXPECT_LT(
        (first.after.position + time * first.after.velocity + fall - second.before.position).norm(),
        2e-6);
    ++flights;
  }
  EXPECT_GT(flights, 100);
}

/// What a plane's motion does to a contact changes nothing.
TEST_F(EdgeWeightTest, IsTheSameEverywhereOnThePlane) {
  GraphSettings wide;
  wide.leastVelocity = -300;
  const ContactGraph graph = graphOf(drops(), body(), wide);
  const PlanarTransform moved = {std::cos(0.7), std::sin(0.7), 3, -2};
  int edges = 0;
  for (const Question& q : asked()) {
    const TransitionSource there = {moved.apply(q.source.before), moved.apply(q.source.after)};
    for (std::uint32_t j = 0; j < graph.database().events(); ++j) {
      const EdgeWeight a = graph.edgeWeight(q.source, q.target, j);
      const EdgeWeight b = graph.edgeWeight(there, q.target, j);
      ASSERT_EQ(a.refusal, b.refusal);
      if (!a.exists()) continue;
      ++edges;
      EXPECT_NEAR(a.total(), b.total(), 1e-9 * (1 - a.total()));
    }
  }
  EXPECT_GT(edges, 100);
}

TEST_F(EdgeWeightTest, NoTransitionToItselfCosts) {
  const ContactGraph graph = graphOf(drops(), body());
  const EventDatabase& database = graph.database();
  int edges = 0;
  for (std::uint32_t j = 0; j + 1 < database.events(); ++j) {
    const EventRecord record = database.record(j);
    const double loud = database.record(0).amplitude;
    const TransitionTarget target = {record.gap, graph.heard(j + 1, loud),
                                     database.record(j + 1).has(EventRecord::kTerminal), loud};
    const ContactEvent event = graph.event(j);
    const EdgeWeight weight = graph.edgeWeight({event.before, event.after}, target, j);
    if (weight.refusal == EdgeRefusal::kNotFlight) continue;
    ASSERT_TRUE(weight.exists()) << j << " " << static_cast<int>(weight.refusal);
    EXPECT_NEAR(weight.total(), 0, 1e-4);  // single precision of the record
    ++edges;
  }
  EXPECT_GT(edges, 100);
}

/// Followed as it was simulated, in a time that is up to 30 % another.
TEST_F(EdgeWeightTest, SilenceIsFollowedAsItWas) {
  const ContactGraph graph = graphOf(drops(), body());
  const EventDatabase& database = graph.database();
  int silent = 0, terminal = 0;
  for (std::uint32_t i = 0; i < database.events(); ++i) {
    const EventRecord record = database.record(i);
    TransitionTarget own;
    own.time = record.gap;
    own.firstAmplitude = record.amplitude;
    const bool touches =
        record.has(EventRecord::kSilentPassage) || record.has(EventRecord::kTouchingAfter);
    if (!record.has(EventRecord::kFollowed) || !touches) {
      EXPECT_EQ(graph.silentWeight(own, i).refusal, EdgeRefusal::kNotFlight);
      continue;
    }
    own.heard = graph.heard(i + 1, record.amplitude);
    own.terminal = database.record(i + 1).has(EventRecord::kTerminal);
    EXPECT_NEAR(graph.silentWeight(own, i).total(), 0, 1e-9);
    own.time = 1.25 * record.gap;
    const EdgeWeight slower = graph.silentWeight(own, i);
    EXPECT_NEAR(slower.total(), logTimeWarp(own.time, record.gap), 1e-9);
    EXPECT_LT(slower.total(), 0);
    own.time = record.gap / 1.31;
    EXPECT_EQ(graph.silentWeight(own, i).refusal, EdgeRefusal::kTime);
    own.time = record.gap;
    own.terminal = !own.terminal;
    EXPECT_EQ(graph.silentWeight(own, i).refusal, EdgeRefusal::kEnd);
    ++silent;
    terminal += !own.terminal;
  }
  EXPECT_GT(silent, 10);
  EXPECT_GT(terminal, 5);
}

TEST_F(EdgeWeightTest, EnergyMayGrowByTheGainOnly) {
  GraphSettings wide, free;
  wide.leastVelocity = free.leastVelocity = -300;
  free.energyGain = 1e9;
  const ContactGraph strict = graphOf(drops(), body(), wide),
                     loose = graphOf(drops(), body(), free);
  std::size_t more = 0;
  for (const Question& q : asked()) {
    for (std::uint32_t j = 0; j < strict.database().events(); ++j) {
      const EdgeWeight a = strict.edgeWeight(q.source, q.target, j);
      const EdgeWeight b = loose.edgeWeight(q.source, q.target, j);
      EXPECT_NE(b.refusal, EdgeRefusal::kEnergy);
      more += a.refusal == EdgeRefusal::kEnergy && b.exists() ? 1 : 0;
      if (a.exists()) {
        EXPECT_EQ(a.total(), b.total());
      }
    }
  }
  EXPECT_GT(more, 0U);
}

}  // namespace
}  // namespace ifa::test
