// SPDX-License-Identifier: Apache-2.0
// Events matched under the body's symmetry group, against databases that hold every image.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "body/object_file.h"
#include "graph/graph_cases.h"

namespace ifa::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Body& die() {
  static const Body body = makeDieBody();
  return body;
}

GraphSettings wide(bool symmetry) {
  GraphSettings settings;
  settings.leastVelocity = -40;  // or few would have neighbours in so small a database
  settings.symmetry = symmetry;
  return settings;
}

/// By matrices, as the record is.
PackedState imageOf(const PackedState& packed, const Matrix3d& element) {
  const RigidState state = unpack(packed);
  const double hand = element.determinant();
  const Matrix3d world = Vector3d(1, hand < 0 ? -1 : 1, 1).asDiagonal();
  RigidState seen = state;
  const Matrix3d axes = world * state.orientation.toRotationMatrix() * element;
  seen.orientation = Eigen::Quaterniond(axes);
  seen.velocity = world * state.velocity;
  seen.angularVelocity = hand < 0 ? -(world * state.angularVelocity) : state.angularVelocity;
  return pack(seen);
}

EventRecord imageOf(EventRecord record, const Matrix3d& element) {
  record.before = imageOf(record.before, element);
  record.after = imageOf(record.after, element);
  if (element.determinant() < 0) {
    record.shift[1] = -record.shift[1];
    record.next[1] = -record.next[1];
  }
  return record;
}

/// A database with the images of all simulations, one element after another.
class ImageDatabase {
 public:
  ImageDatabase(const DropDatabase& drops, const std::vector<Matrix3d>& elements) {
    const EventDatabase database = drops.open();
    DatabaseHeader header = database.header();
    header.identity.allSimulations *= elements.size();
    header.simulations = header.identity.allSimulations;
    EventBlock block;
    for (const Matrix3d& element : elements) {
      for (std::size_t i = 0; i < database.events(); ++i)
        block.records.push_back(imageOf(database.record(i), element));
      for (std::size_t s = 0; s < database.header().simulations; ++s)
        block.counts.push_back(
            static_cast<std::uint32_t>(database.firstEvent(s + 1) - database.firstEvent(s)));
    }
    auto journal = Journal::create(path(), header);
    EXPECT_TRUE(journal->append(block));
    EXPECT_TRUE(journal->assemble(path(), [](double) {}));
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "images.ifadb"; }

 private:
  TemporaryFolder folder_;
};

/// Weights of the best edges, each event with its best image only.
std::vector<double> bestOfImages(const ContactGraph& images, std::size_t events, const Question& q,
                                 std::size_t count) {
  std::vector<double> best(events, -1e9);
  for (const Transition& t : images.bestByScan(q.source, q.target, images.database().events()))
    best[t.sibling % events] = std::max(best[t.sibling % events], t.total);
  std::sort(best.begin(), best.end(), std::greater<>());
  while (!best.empty() && best.back() == -1e9) best.pop_back();
  best.resize(std::min(best.size(), count));
  return best;
}

TEST(GraphSymmetry, IsADatabaseOfAllImagesSlow) {
  const DropDatabase drops(die(), 25, 3);
  const ContactGraph graph = graphOf(drops, die(), wide(true));
  ASSERT_EQ(graph.symmetry().order(), 48U);
  const ImageDatabase every(drops, graph.symmetry().elements());
  const auto images =
      ContactGraph::make(*EventDatabase::open(every.path()), die(), wide(false)).value();
  const std::size_t events = graph.database().events();
  ASSERT_EQ(images.database().events(), 48 * events);
  std::size_t edges = 0;
  for (const Question& q : questions(DropDatabase(die(), 40, 4), 40)) {
    const auto truth = bestOfImages(images, events, q, 5);
    const auto found = graph.bestByScan(q.source, q.target, 5);
    ASSERT_EQ(found.size(), truth.size());
    edges += found.size();
    // The images are kept in single precision.
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i].total, truth[i], 2e-3 - 1e-4 * truth[i]);
  }
  EXPECT_GT(edges, 60U);
}

struct Recall {
  double found = 0, lost = 0;
  std::size_t edges = 0, images = 0;
};

/// Share of the scan's edges that the tree finds, by weight.
Recall recallOf(const ContactGraph& graph, const std::vector<Question>& asked) {
  Recall recall;
  for (const Question& q : asked) {
    const auto found = graph.best(q.source, q.target, 5);
    const auto truth = graph.bestByScan(q.source, q.target, 5);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const bool there = std::any_of(found.begin(), found.end(), [&](const Transition& t) {
        return t.sibling == truth[i].sibling && t.total > truth[i].total - 1e-6;
      });
      recall.found += there;
      recall.images += truth[i].symmetry != 0;
    }
    recall.edges += truth.size();
  }
  recall.found /= static_cast<double>(recall.edges);
  return recall;
}

TEST(GraphSymmetry, TheTreesFindTheBestImagesSlow) {
  struct Case {
    const char* object;
    std::uint64_t drops;
    std::size_t questions;
  };
  for (const auto& [object, drops, count] :
       {Case{"d6", 150, 50}, {"d20", 60, 20}, {"Nut", 250, 60}, {"CoffeeCup", 400, 60}}) {
    const Body body = loadObject(object).value();
    const DropDatabase database(body, drops, 3);
    const auto asked = questions(DropDatabase(body, 60, 4), count);
    const ContactGraph graph = graphOf(database, body, wide(true));
    const Recall with = recallOf(graph, asked);
    const Recall without = recallOf(graphOf(database, body, wide(false)), asked);
    EXPECT_GE(with.found, 0.98) << object;
    EXPECT_GT(with.edges, without.edges) << object;
    EXPECT_GT(with.images, with.edges / 3) << object;
    EXPECT_EQ(without.images, 0U) << object;
  }
}

/// The weight of an image is that of the source's own image, and no event comes twice.
TEST(GraphSymmetry, EdgesAreThoseOfTheSourcesImages) {
  const ContactGraph graph = graphOf(DropDatabase(die(), 150, 3), die(), wide(true));
  for (const Question& q : questions(DropDatabase(die(), 40, 4), 30)) {
    const auto edges = graph.best(q.source, q.target, 10);
    for (std::size_t element = 0; element < graph.symmetry().order(); element += 7) {
      const SymmetryImage& image = graph.image(element);
      const TransitionSource seen = {image.apply(q.source.before), image.apply(q.source.after)};
      const auto again = graph.best(seen, q.target, 10);
      ASSERT_EQ(again.size(), edges.size());
      for (std::size_t i = 0; i < edges.size(); ++i) {
        EXPECT_NEAR(again[i].total, edges[i].total, 1e-9);
        EXPECT_EQ(again[i].sibling, edges[i].sibling);
        const std::size_t expected = graph.symmetry().product(edges[i].symmetry, element);
        EXPECT_NEAR(graph.edgeWeight(seen, q.target, edges[i].sibling, expected).total(),
                    edges[i].total, 1e-9);
      }
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      EXPECT_EQ(graph.edgeWeight(q.source, q.target, edges[i].sibling, edges[i].symmetry).total(),
                edges[i].total);
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(edges[i].sibling, edges[j].sibling);
    }
  }
}

}  // namespace
}  // namespace ifa::test
