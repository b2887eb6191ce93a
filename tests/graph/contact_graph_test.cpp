// SPDX-License-Identifier: Apache-2.0
#include "graph/contact_graph.h"

#include <algorithm>

#include "base/parallel.h"
#include "graph/graph_cases.h"
#include "graph/tree_events.h"

namespace ifa::test {
namespace {

class ContactGraphTest : public testing::Test {
 protected:
  static const Body& body() {
    static const Body body = makeBoxBody({0.03, 0.02, 0.012}, 0.02);
    return body;
  }
  static const DropDatabase& drops() {
    static const DropDatabase drops(body(), 1500, 3);
    return drops;
  }
  static const std::vector<Question>& asked() {
    static const std::vector<Question> all = questions(DropDatabase(body(), 100, 4), 150);
    return all;
  }
  static GraphSettings wide() {
    GraphSettings settings;
    settings.leastVelocity = -40;  // or few would have neighbours in so small a database
    return settings;
  }
  /// Share of the questions for which the tree gives all that the scan gives.
  static double recall(const ContactGraph& graph, std::size_t& edges) {
    double complete = 0;
    edges = 0;
    for (const Question& q : asked()) {
      const auto found = graph.best(q.source, q.target, 5);
      const auto truth = graph.bestByScan(q.source, q.target, 5);
      edges += truth.size();
      complete += std::equal(found.begin(), found.end(), truth.begin(), truth.end(),
                             [](const Transition& a, const Transition& b) {
                               return a.sibling == b.sibling && a.total == b.total;
                             });
    }
    return complete / static_cast<double>(asked().size());
  }
};

TEST_F(ContactGraphTest, FindsWhatAFullScanFindsSlow) {
  GraphSettings warped = wide(), printed = wide();
  warped.connection = ConnectionKind::kBlend;
  printed.velocityReference = VelocityReference::kPrinted;
  for (const GraphSettings& settings : {wide(), warped, printed}) {
    std::size_t edges = 0;
    EXPECT_GE(recall(graphOf(drops(), body(), settings), edges), 0.98);
    EXPECT_GT(edges, asked().size());
  }
}

/// Every leaf looked into: what is left is the weight in single precision.
TEST_F(ContactGraphTest, SinglePrecisionRanksAsDouble) {
  GraphSettings plain = wide();
  plain.symmetry = false;
  const ContactGraph graph = graphOf(drops(), body(), plain);
  for (const Question& q : asked()) {
    std::vector<Transition> best;
    const TreeQuery query(body(), graph.settings(), q.source, q.target);
    for (const TreeFind& find : graph.tree(q.target.terminal).scan(query, 5)) {
      const EdgeWeight weight = graph.edgeWeight(q.source, q.target, find.sibling);
      if (!weight.exists()) continue;
      EXPECT_NEAR(find.total, weight.total(), 2e-3 - 1e-4 * weight.total());
      best.push_back({find.sibling, weight, weight.total()});
    }
    std::sort(best.begin(), best.end(), [](const Transition& a, const Transition& b) {
      return a.total != b.total ? a.total > b.total : a.sibling < b.sibling;
    });
    best.resize(std::min<std::size_t>(best.size(), 5));
    expectSame(best, graph.bestByScan(q.source, q.target, 5));
  }
}

TEST_F(ContactGraphTest, ScanIsEveryEdgeWeighed) {
  const DropDatabase few(body(), 40, 6);
  const ContactGraph graph = graphOf(few, body(), wide());
  for (const Question& q : asked()) {
    std::vector<Transition> all;
    for (std::uint32_t j = 0; j < graph.database().events(); ++j) {
      std::optional<Transition> heaviest;
      for (std::uint32_t s = 0; s < graph.symmetry().order(); ++s) {
        const EdgeWeight weight = graph.edgeWeight(q.source, q.target, j, s);
        if (weight.exists() && !(heaviest && weight.total() <= heaviest->total))
          heaviest = {j, weight, weight.total(), s};
      }
      if (heaviest) all.push_back(*heaviest);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Transition& a, const Transition& b) { return a.total > b.total; });
    all.resize(std::min<std::size_t>(all.size(), 7));
    expectSame(graph.bestByScan(q.source, q.target, 7), all);
  }
}

TEST_F(ContactGraphTest, IsTheSameOnAnyNumberOfThreads) {
  setThreadCount(1);
  const ContactGraph one = graphOf(drops(), body(), wide());
  setThreadCount(0);
  const ContactGraph all = graphOf(drops(), body(), wide());
  for (const Question& q : asked()) {
    const TreeQuery query(body(), one.settings(), q.source, q.target);
    const auto a = one.tree(q.target.terminal).find(query, 20, 12);
    const auto b = all.tree(q.target.terminal).find(query, 20, 12);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].sibling, b[i].sibling);
      EXPECT_EQ(a[i].total, b[i].total);
    }
    expectSame(one.best(q.source, q.target, 5), all.best(q.source, q.target, 5));
  }
}

TEST_F(ContactGraphTest, LeadsByFlightToWhatWasAskedFor) {
  const ContactGraph graph = graphOf(drops(), body(), wide());
  const EventDatabase& database = graph.database();
  std::size_t ends = 0;
  for (Question q : asked()) {
    for (const bool terminal : {false, true}) {
      q.target.terminal = terminal;
      for (const Transition& t : graph.best(q.source, q.target, 50)) {
        const EventRecord sibling = database.record(t.sibling);
        EXPECT_TRUE(sibling.has(EventRecord::kFollowed));
        EXPECT_FALSE(sibling.has(EventRecord::kSilentPassage));
        EXPECT_FALSE(sibling.has(EventRecord::kTouchingAfter));
        EXPECT_EQ(database.record(t.event()).has(EventRecord::kTerminal), terminal);
        ends += terminal ? 1 : 0;
      }
    }
  }
  EXPECT_GT(ends, 0U);
}

/// Both trees hold each flight once.
TEST_F(ContactGraphTest, TreesHoldEveryFlight) {
  const EventDatabase database = drops().open();
  const auto events = treeEvents(database, {}, {});
  ASSERT_TRUE(events);
  std::vector<std::uint32_t> expected, held;
  for (std::uint32_t j = 0; j < database.events(); ++j) {
    const EventRecord r = database.record(j);
    if (r.has(EventRecord::kFollowed) && !r.has(EventRecord::kSilentPassage) &&
        !r.has(EventRecord::kTouchingAfter)) {
      expected.push_back(j);
    }
  }
  for (const auto* tree : {&events->onward, &events->ending})
    for (const TreeEvent& event : *tree) held.push_back(event.sibling);
  std::sort(held.begin(), held.end());
  EXPECT_EQ(held, expected);
}

TEST_F(ContactGraphTest, StartsAreTheBestOfAll) {
  const ContactGraph graph = graphOf(drops(), body());
  const EventDatabase& database = graph.database();
  const HeardEvent first = {1, 0.02, 0.01};
  const TransitionTarget second = {0, {0.6, 0, 0}, false, 0};
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::uint32_t j = 0; j < database.events(); ++j) {
    const EventRecord r = database.record(j);
    const ContactEvent event = graph.event(j);
    const double time = 0.15 - r.duration;
    if (!(time > 0)) continue;
    const TransitionTarget target = {time, second.heard, false, r.amplitude};
    const bool silent = isLeftInSilence(database.flags(), j);
    const EdgeWeight weight = silent ? graph.silentWeight(target, j)
                                     : graph.edgeWeight({event.before, event.after}, target, j);
    const HeardEvent heard = graph.heard(j, r.amplitude);
    if (weight.exists()) {
      all.emplace_back(-weight.total() - logDuration(first, heard) - logCentroid(first, heard), j);
    }
  }
  std::sort(all.begin(), all.end());
  const auto starts = graph.bestStarts(0.15, first, second, 25);
  ASSERT_EQ(starts.size(), 25U);
  ASSERT_GE(all.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_NEAR(starts[i].total, -all[i].first, 1e-9 * (1 + all[i].first));
    EXPECT_EQ(starts[i].first, all[i].second);
  }
}

TEST_F(ContactGraphTest, TerminalsAreTheBestOfAll) {
  const ContactGraph graph = graphOf(drops(), body());
  const HeardEvent heard = {1, 0.15, 0.05};
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::uint32_t i = 0; i < graph.database().events(); ++i) {
    if (!graph.database().record(i).has(EventRecord::kTerminal)) continue;
    const HeardEvent event = graph.heard(i, 1);
    all.emplace_back(-logDuration(heard, event) - logCentroid(heard, event), i);
  }
  std::sort(all.begin(), all.end());
  const auto found = graph.bestAlone(heard, true, 10);
  ASSERT_EQ(found.size(), 10U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].event, all[i].second);
    EXPECT_EQ(found[i].total, -all[i].first);
  }
}

TEST_F(ContactGraphTest, NothingComesOfNothing) {
  const DropDatabase none(body(), 0, 3);
  const ContactGraph graph = graphOf(none, body());
  const Question& q = asked()[0];
  EXPECT_TRUE(graph.best(q.source, q.target, 5).empty());
  EXPECT_TRUE(graph.bestByScan(q.source, q.target, 5).empty());
  EXPECT_TRUE(graph.bestStarts(0.1, {}, {}, 5).empty());
  EXPECT_TRUE(graph.bestAlone({}, true, 5).empty());
}

TEST_F(ContactGraphTest, NoneAskedForNoneGiven) {
  const ContactGraph graph = graphOf(drops(), body());
  Question q = asked()[0];
  EXPECT_TRUE(graph.best(q.source, q.target, 0).empty());
  EXPECT_TRUE(graph.bestByScan(q.source, q.target, 0).empty());
  EXPECT_TRUE(graph.bestAlone({}, true, 0).empty());
  q.target.time = 0;
  EXPECT_TRUE(graph.best(q.source, q.target, 5).empty());
  EXPECT_TRUE(graph.bestByScan(q.source, q.target, 5).empty());
}

TEST_F(ContactGraphTest, RefusesAnotherBody) {
  const auto graph = ContactGraph::make(drops().open(), makeDieBody());
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.error().code, ErrorCode::kBadInput);
  EXPECT_NE(graph.error().message.find("another body"), std::string::npos);
}

TEST_F(ContactGraphTest, StopsWhenAsked) {
  const std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  const auto graph = ContactGraph::make(drops().open(), body(), {}, progress);
  ASSERT_FALSE(graph);
  EXPECT_EQ(graph.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace ifa::test
