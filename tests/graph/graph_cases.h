// SPDX-License-Identifier: Apache-2.0
// Databases of simulated drops, and questions to their graphs.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "base/random.h"
#include "database/journal.h"
#include "dynamics/simulator.h"
#include "graph/contact_graph.h"
#include "sampler/drop_statistics.h"
#include "sampler/event_chain.h"
#include "sampler/initial_state.h"
#include "support/box_body.h"
#include "support/temporary_folder.h"

namespace ifa::test {

inline SurfaceProperties graphSurface(const Body& body) {
  SurfaceProperties surface;
  surface.restitution = 0.7;
  surface.friction = 0.35;
  surface.rollingFriction = surface.spinningFriction = 2e-4;
  surface.referenceImpulse = body.mass * 2 * (1 + surface.restitution);
  return surface;
}

/// Drops of a body, as events in a file of its own.
class DropDatabase {
 public:
  DropDatabase(const Body& body, std::uint64_t drops, std::uint64_t seed) {
    const SurfaceProperties surface = graphSurface(body);
    const BodyModel model(body, surface);
    const RecorderSettings cut = audibleCut(body, surface);
    DatabaseHeader header;
    header.identity.simulationVersion = kSimulationVersion;
    header.identity.seed = seed;
    header.identity.allSimulations = header.simulations = drops;
    header.identity.bodyHash = hashOf(body);
    header.identity.settings.mergeGap = cut.mergeGap;
    header.identity.settings.referenceImpulse = surface.referenceImpulse;
    header.identity.settingsHash = hashOf(header.identity.settings);
    EventBlock block;
    EventChain chain(model, cut);
    for (std::uint64_t d = 0; d < drops; ++d) {
      const std::size_t before = block.records.size();
      chain.simulate(sampleInitialState(body, seed, d), 20, block.records);
      block.counts.push_back(static_cast<std::uint32_t>(block.records.size() - before));
    }
    auto journal = Journal::create(path(), header);
    if (drops > 0) {
      EXPECT_TRUE(journal->append(block));
    }
    EXPECT_TRUE(journal->assemble(path(), [](double) {}));
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_ / "drops.ifadb"; }
  [[nodiscard]] EventDatabase open() const { return *EventDatabase::open(path()); }

 private:
  TemporaryFolder folder_;
};

/// A graph that must be made.
inline ContactGraph graphOf(const DropDatabase& drops, const Body& body,
                            const GraphSettings& settings = {}) {
  auto graph = ContactGraph::make(drops.open(), body, settings);
  EXPECT_TRUE(graph) << graph.error().text();
  return std::move(*graph);
}

struct Question {
  TransitionSource source;
  TransitionTarget target;
};

/// Contacts of drops, and what followed them, changed a little.
inline std::vector<Question> questions(const DropDatabase& drops, std::size_t count) {
  const EventDatabase database = drops.open();
  std::vector<Question> all;
  for (std::size_t q = 0; all.size() < count; ++q) {
    RandomStream random(5, q);
    const std::size_t i = random.below(database.events() - 1);
    const EventRecord from = database.record(i);
    if (!from.has(EventRecord::kFollowed) || from.has(EventRecord::kSilentPassage)) continue;
    const double first = database.header().identity.settings.referenceImpulse;
    HeardEvent heard = heardEvent(database, i + 1, first);
    heard.amplitude *= random.uniform(0.7, 1.3);
    all.push_back({{unpack(from.before), unpack(from.after)},
                   {from.gap * random.uniform(0.9, 1.1), heard,
                    database.record(i + 1).has(EventRecord::kTerminal), first}});
  }
  return all;
}

inline void expectSame(const std::vector<Transition>& a, const std::vector<Transition>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].sibling, b[i].sibling);
    EXPECT_EQ(a[i].total, b[i].total);
  }
}

}  // namespace ifa::test
