// SPDX-License-Identifier: Apache-2.0
// Plans of the graph planner become motions that hold the audit, and say of themselves what is
// true.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "audit/audit.h"
#include "dynamics/flight.h"
#include "motion/build_motion.h"
#include "planner/graph_plan.h"
#include "planner/graph_plan_cases.h"
#include "planner/graph_planner.h"
#include "support/drop_database.h"

namespace ifa::test {
namespace {

/// Enough drops for most signatures to be met.
const DropDatabase& drops(EventCut cut) {
  const auto make = [](EventCut kind) {
    return DropDatabase(graphDie(), graphDieSurface(), 5000, 21, kind);
  };
  static const DropDatabase audible = make(EventCut::kAudible), paper = make(EventCut::kPaper);
  return cut == EventCut::kPaper ? paper : audible;
}

/// What is heard of a few others.
const ContactGraph& others() {
  static const ContactGraph others =
      graphOf(DropDatabase(graphDie(), graphDieSurface(), 200, 22), graphDie());
  return others;
}

struct Kind {
  const char* name;
  ConnectionKind connection;
  VelocityReference reference;
  int solved;  ///< no fewer of the signatures
  EventCut cut = EventCut::kAudible;
  bool symmetry = false;
};

struct Planned {
  PlanRequest request;
  Plan plan;
  Motion motion;
};

class GraphPlans : public testing::TestWithParam<Kind> {
 protected:
  struct World {
    ContactGraph graph;
    std::vector<Planned> planned;
    int solved = 0;
  };
  /// Of drops that the database holds, and of others.
  static std::vector<ContactSignature> heardSignatures(const ContactGraph& graph, std::size_t n,
                                                       bool terminal) {
    const bool paper = GetParam().cut == EventCut::kPaper;
    const std::size_t held = paper ? 2 : GetParam().symmetry ? 0 : 1;
    const std::size_t more = paper ? 0 : 2 + held;
    auto all = signaturesOf(graph, held, n, terminal, n);
    for (const auto& other : signaturesOf(others(), more, n, terminal, n)) {
      all.push_back(other);
    }
    return all;
  }
  /// Signatures of 4 to 8 contacts, planned once for all tests of a kind.
  static World& world() {
    static std::map<std::string, World> all;
    const auto known = all.find(GetParam().name);
    if (known != all.end()) return known->second;
    GraphSettings settings;
    settings.connection = GetParam().connection;
    settings.velocityReference = GetParam().reference;
    settings.symmetry = GetParam().symmetry;
    World& made = all.emplace(GetParam().name,
                              World{graphOf(drops(GetParam().cut), graphDie(), settings), {}, 0})
                      .first->second;
    for (std::size_t n = 4; n <= 8; ++n) {
      for (const bool terminal : {false, true}) {
        for (const auto& signature : heardSignatures(made.graph, n, terminal)) {
          Planned one{graphRequest(graphDie(), graphDieSurface(), made.graph, signature), {}, {}};
          one.plan = GraphPlanner(quickGraphSearch()).plan(one.request, {}).value().at(0);
          auto motion = buildMotion(one.request, one.plan, 0.3);
          EXPECT_TRUE(motion) << motion.error().text();
          if (motion) one.motion = std::move(*motion);
          one.motion.object.surface = graphDie().definition.defaultSurface;
          made.solved += one.plan.solved;
          made.planned.push_back(std::move(one));
        }
      }
    }
    return made;
  }

  // Each looks at all plans of the world.
  static void onlyBlendsWarpTime();
  static void silenceIsThatOfADrop();
  static void scoresAreThoseOfTheMotion();
  static void flightsEndWhereTheNextEventBegins();
  static void placementsAreThoseOfTheImages();
  static void whatIsSeenIsContinuous();
  static void theAuditFindsAnUnderstatedArrival();
};

/// What is not flown is followed in one simulation, unchanged but for its pace.
void GraphPlans::silenceIsThatOfADrop() {
  int silences = 0;
  for (const Planned& one : world().planned) {
    for (std::size_t i = 1; i < one.plan.contacts.size(); ++i) {
      const PlannedContact &from = one.plan.contacts[i - 1], &to = one.plan.contacts[i];
      EXPECT_EQ(to.unbroken, to.arrival == Arrival::kSilentContact);
      if (!to.unbroken) continue;
      EXPECT_EQ(to.source.simulation, from.source.simulation);
      EXPECT_EQ(to.source.event, from.source.event + 1);
      EXPECT_EQ(from.velocityChange.norm() + from.angularVelocityChange.norm(), 0);
      EXPECT_LT(to.bend + to.arrivalBend, 1e-4);  // single precision
      ++silences;
    }
  }
  EXPECT_GE(silences, GetParam().cut == EventCut::kAudible ? 3 : 0);
}

void GraphPlans::onlyBlendsWarpTime() {
  double farthest = 0;
  for (const Planned& one : world().planned) {
    for (const PlannedContact& contact : one.plan.contacts) {
      const double amount = std::max(contact.retiming, 1 / contact.retiming) - 1;
      EXPECT_LT(amount, 0.3);
      if (contact.arrival == Arrival::kFlight) farthest = std::max(farthest, amount);
    }
  }
  if (GetParam().connection == ConnectionKind::kExact) {
    EXPECT_EQ(farthest, 0);
  } else {
    EXPECT_GT(farthest, 1e-3);
  }
}

/// Equations 2 and 3 once more. @param reference  changes by the contact
double bendOf(const Eigen::Vector3d& v, const Eigen::Vector3d& w, const Eigen::Vector3d& linear,
              const Eigen::Vector3d& angular) {
  const auto squared = [](const Eigen::Vector3d& change, const Eigen::Vector3d& reference,
                          double size, double degrees, double smallest) {
    const double axis = size * std::max(reference.norm(), smallest);
    const double along = change.dot(reference.normalized());
    const double across = (change - along * reference.normalized()).norm();
    return std::pow(along / axis, 2) +
           std::pow(across / (axis * std::tan(degrees * M_PI / 180)), 2);
  };
  return std::sqrt(squared(v, linear, 0.4, 20, 0.05) +
                   squared(w, angular, 0.2, 10, 0.05 / graphDie().radius));
}

/// Factors of the edge that leads from one contact to another, from what the plan says of both.
class Recomputed {
 public:
  Recomputed(const PlanRequest& request, const Plan& plan, std::size_t i)
      : target_(request.signature.events[i]), to_(plan.contacts[i]) {
    if (i > 0) from_ = &plan.contacts[i - 1];
  }
  [[nodiscard]] double bend() const {
    const ContactEvent& event = from_->event;
    return bendOf(from_->velocityChange, from_->angularVelocityChange,
                  event.after.velocity - event.before.velocity,
                  event.after.angularVelocity - event.before.angularVelocity);
  }
  [[nodiscard]] double v() const { return std::exp(-std::pow(bend(), 2)); }
  [[nodiscard]] double t() const {
    return std::exp(-100 * std::pow(std::max(stretch(), 1 / stretch()) - 1, 2));
  }
  /// What the plane's turn leaves between i+ and the image of j+, j from the database.
  [[nodiscard]] double q(const ContactGraph& graph, std::uint32_t sibling, bool blend) const {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d a = from_->event.after.orientation.conjugate() * up;
    const SymmetryGroup& group = graph.symmetry();
    const std::size_t step =
        group.product(static_cast<std::size_t>(to_.source.symmetry),
                      group.inverse(static_cast<std::size_t>(from_->source.symmetry)));
    const RigidState image = graph.image(step).apply(graph.event(sibling).after);
    const Eigen::Vector3d b = image.orientation.conjugate() * up;
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    const double shown = to_.time - from_->time - from_->event.end;
    const double time = std::min(blend ? shown / to_.retiming : shown, 0.2);
    return std::exp(-0.85 * std::pow(angle / time, 2));
  }
  [[nodiscard]] double a(double first) const {
    return std::exp(-2.78 * std::pow(target_.amplitude - to_.event.amplitude / first, 2));
  }
  [[nodiscard]] double duration() const {
    return to_.event.filteredDuration(graphDie().definition.mergeGap);
  }
  [[nodiscard]] double l() const {
    if (target_.duration == 0 && duration() == 0) return 1;
    return std::exp(-7000 * std::pow(target_.duration - duration(), 2));
  }
  [[nodiscard]] double c() const {
    const double heard = duration() > 0 ? to_.event.centroid : 0;
    return std::exp(-7000 * std::pow(target_.centroid - heard, 2));
  }

 private:
  [[nodiscard]] double stretch() const { return to_.retiming; }

  const SignatureEvent& target_;
  const PlannedContact& to_;
  const PlannedContact* from_ = nullptr;
};

void GraphPlans::scoresAreThoseOfTheMotion() {
  const bool printed = GetParam().reference == VelocityReference::kPrinted;
  const ContactGraph& graph = world().graph;
  for (const Planned& one : world().planned) {
    const auto& contacts = one.plan.contacts;
    double product = 1, motion = 1, v = 1, largest = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Recomputed again(one.request, one.plan, i);
      const ContactFactors& f = contacts[i].factors;
      EXPECT_NEAR(f.a, again.a(contacts[0].event.amplitude), 1e-5);
      EXPECT_NEAR(f.l, again.l(), 1e-5);
      EXPECT_NEAR(f.c, again.c(), 1e-5);
      if (i > 0) {
        const auto event =
            graph.database().firstEvent(static_cast<std::size_t>(contacts[i].source.simulation)) +
            static_cast<std::size_t>(contacts[i].source.event);
        const bool blend = GetParam().connection == ConnectionKind::kBlend;
        EXPECT_NEAR(f.q, again.q(graph, static_cast<std::uint32_t>(event) - 1, blend), 1e-4);
        EXPECT_NEAR(contacts[i].bend, again.bend(), 1e-9);
        EXPECT_NEAR(f.t, again.t(), 1e-5);
        if (!printed) {
          EXPECT_NEAR(f.v, again.v(), 1e-9);
        }
        largest = std::max(largest, contacts[i].bend);
      } else {
        EXPECT_EQ(f.v * f.q * f.t, 1);
      }
      motion *= f.v * f.q * f.t;
      product *= f.v * f.q * f.t * f.a * f.l * f.c;
      v *= f.v;
    }
    if (contacts.empty()) continue;
    const auto n = static_cast<double>(contacts.size());
    EXPECT_NEAR(one.plan.score, std::pow(product, 1 / (6 * n)), 1e-9);
    EXPECT_NEAR(one.plan.scoreWithoutSound, std::pow(motion, 1 / (3 * n)), 1e-9);
    EXPECT_NEAR(one.plan.meanFv, std::pow(v, 1 / n), 1e-9);
    EXPECT_EQ(one.plan.bendMax, largest);
    EXPECT_LE(one.plan.bendMax, one.plan.bendCap);
  }
}

/// Free flight by the simulator's own path.
RigidState fly(const BodyModel& model, const RigidState& start, double duration) {
  KernelState<double> state = kernelState(start, 0);
  while (state.time < duration) {
    const FlightSegment segment(model, state, duration - state.time);
    state = segment.at(std::min(segment.length(), duration - state.time));
  }
  return rigidState(state);
}

/// Where a flight ends the next event begins: laid into one world, the poses are the same.
void GraphPlans::flightsEndWhereTheNextEventBegins() {
  const BodyModel model(graphDie(), graphDieSurface());
  // The printed Newton iteration ends sooner (5.3.2).
  const double turned = GetParam().connection == ConnectionKind::kExact ? 1e-9 : 2e-6;
  int flights = 0, others = 0;  // to the contact of another drop
  for (const Planned& one : world().planned) {
    for (std::size_t i = 1; i < one.plan.contacts.size(); ++i) {
      const PlannedContact &from = one.plan.contacts[i - 1], &to = one.plan.contacts[i];
      if (to.arrival != Arrival::kFlight) continue;
      RigidState departure = from.event.after;
      departure.velocity += from.velocityChange;
      departure.angularVelocity += from.angularVelocityChange;
      const double shown = to.time - from.time - from.event.end;
      const RigidState end = fly(model, from.placement.apply(departure), shown / to.retiming);
      const RigidState begin = to.placement.apply(to.event.before);
      EXPECT_LT((end.position - begin.position).norm(), 1e-9);
      EXPECT_LT(end.orientation.angularDistance(begin.orientation), turned);
      const Eigen::Vector3d slower = to.placement.direction(to.arrivalChange);
      const Eigen::Vector3d lessSpin = to.placement.axial(to.arrivalAngularChange);
      EXPECT_LT((end.velocity - (begin.velocity - slower)).norm(), 1e-8);
      EXPECT_LT((end.angularVelocity - (begin.angularVelocity - lessSpin)).norm(), 1e-5);
      ++flights;
      others += from.source.simulation != to.source.simulation;
    }
  }
  EXPECT_GT(flights, 40);
  EXPECT_GE(others, 2);
}

/// With symmetry on contacts are seen as images, some of them in the mirror, and placed as the
/// number of the image says; off, as they are.
void GraphPlans::placementsAreThoseOfTheImages() {
  const ContactGraph& graph = world().graph;
  int images = 0, mirrored = 0;
  for (const Planned& one : world().planned) {
    for (const PlannedContact& contact : one.plan.contacts) {
      const SymmetryImage& image = graph.image(static_cast<std::size_t>(contact.source.symmetry));
      EXPECT_EQ(contact.placement.image.mirrored, image.mirrored);
      EXPECT_LT(contact.placement.image.relabelling.angularDistance(image.relabelling), 1e-12);
      images += contact.source.symmetry != 0;
      mirrored += image.mirrored;
    }
  }
  EXPECT_EQ(images > 15, GetParam().symmetry);
  EXPECT_EQ(mirrored > 5, GetParam().symmetry);
  if (!GetParam().symmetry) {
    EXPECT_EQ(images, 0);
  }
}

/// Nothing jumps or turns over where one image gives way to another.
void GraphPlans::whatIsSeenIsContinuous() {
  for (const Planned& one : world().planned) {
    const auto& samples = one.motion.trajectory;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const MotionSample &a = samples[i - 1], &b = samples[i];
      const double time = b.time - a.time;
      const double spin = std::max(a.angularVelocity.norm(), b.angularVelocity.norm());
      const double speed = std::max(a.velocity.norm(), b.velocity.norm());
      EXPECT_LT(a.orientation.angularDistance(b.orientation), 1.5 * spin * time + 1e-4);
      EXPECT_LT((a.position - b.position).norm(), 1.5 * speed * time + 1e-5);
    }
  }
}

/// Whoever says that a body arrives more gently than it does is found out.
void GraphPlans::theAuditFindsAnUnderstatedArrival() {
  int tried = 0;
  for (const Planned& one : world().planned) {
    for (std::size_t i = 1; i < one.motion.contacts.size() && one.plan.solved; ++i) {
      if (one.motion.contacts[i].arrivalBend < 1e-3) continue;
      Motion half = one.motion;
      half.contacts[i].arrivalBend *= 0.5;
      const AuditCheck* check = nullptr;
      const AuditReport report = audit(half, graphDie());
      check = report.find("bend understated");
      ASSERT_NE(check, nullptr);
      EXPECT_FALSE(check->passed);
      ++tried;
    }
  }
  EXPECT_GE(tried, 3);
}

/// A wrench turns about its long axis with a hundredth of the moment that it has about others:
/// rounded to single precision its spin is another angular momentum.
TEST(GraphPlan, SilenceOfASlenderBodyKeepsItsMomentum) {
  const Body body = loadObject("Wrench").value();
  const SurfaceProperties surface = body.definition.surfaces.at("desk");
  const ContactGraph graph = graphOf(DropDatabase(body, surface, 100, 21), body);
  RandomStream random(1, 1);
  int silences = 0;
  for (std::uint32_t first = 0; first + 1 < graph.database().events() && silences < 100; ++first) {
    const auto heard = signatureFrom(graph, first, 2, {0, 0}, random);
    if (!heard) continue;
    PlanRequest request = graphRequest(body, surface, graph, *heard);
    TransitionTarget target;
    target.time = heard->events[1].time - graph.database().values(kDuration)[first];
    target.heard = heardOf(heard->events[1]);
    target.firstAmplitude = graph.event(first).amplitude;
    target.terminal = heard->terminal;
    const EdgeWeight silence = graph.silentWeight(target, first);
    if (!silence.exists()) continue;
    PathConnector connector(request);
    GraphPath path;
    path.first = first;
    path.firstAmplitude = target.firstAmplitude;
    path.edges.push_back({first, target.time, silence, 0, 0});
    auto motion = buildMotion(request, planOf(request, path, connector), 0);
    ASSERT_TRUE(motion) << motion.error().text();
    motion->object.surface = "desk";
    const AuditReport report = audit(*motion, body);
    EXPECT_TRUE(report.find("angular momentum")->passed) << formatAudit(report);
    ++silences;
  }
  EXPECT_GE(silences, 50);
}

TEST_P(GraphPlans, MeetManySignaturesOfDropsAndHoldTheAudit) {
  const bool both = GetParam().cut == EventCut::kAudible && !GetParam().symmetry;
  EXPECT_EQ(world().planned.size(), both ? 40U : 20U);
  EXPECT_GE(world().solved, GetParam().solved);
  for (const Planned& one : world().planned) {
    if (!one.plan.solved) continue;
    const AuditReport report = audit(one.motion, graphDie());
    EXPECT_TRUE(report.passed()) << formatAudit(report);
    ASSERT_EQ(one.motion.contacts.size(), one.request.signature.events.size());
    for (std::size_t i = 0; i < one.motion.contacts.size(); ++i)
      EXPECT_NEAR(one.motion.contacts[i].time, one.request.signature.events[i].time, 1e-12);
    EXPECT_EQ(one.motion.contacts.back().terminal, one.request.signature.terminal);
    EXPECT_EQ(one.motion.cut, GetParam().cut);
  }
  // Planning takes longest, so all that is to be seen of the plans is one test.
  onlyBlendsWarpTime();
  silenceIsThatOfADrop();
  scoresAreThoseOfTheMotion();
  flightsEndWhereTheNextEventBegins();
  placementsAreThoseOfTheImages();
  whatIsSeenIsContinuous();
  theAuditFindsAnUnderstatedArrival();
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, GraphPlans,
    testing::Values(Kind{"Exact", ConnectionKind::kExact, VelocityReference::kBlend, 8},
                    Kind{"ExactPrinted", ConnectionKind::kExact, VelocityReference::kPrinted, 7},
                    Kind{"Blend", ConnectionKind::kBlend, VelocityReference::kBlend, 10},
                    Kind{"BlendPrinted", ConnectionKind::kBlend, VelocityReference::kPrinted, 10},
                    Kind{"PapersCut", ConnectionKind::kBlend, VelocityReference::kPrinted, 8,
                         EventCut::kPaper},
                    Kind{"PapersCutExact", ConnectionKind::kExact, VelocityReference::kBlend, 6,
                         EventCut::kPaper},
                    Kind{"Symmetric", ConnectionKind::kExact, VelocityReference::kBlend, 6,
                         EventCut::kAudible, true},
                    Kind{"SymmetricBlend", ConnectionKind::kBlend, VelocityReference::kBlend, 7,
                         EventCut::kAudible, true}),
    [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace ifa::test
