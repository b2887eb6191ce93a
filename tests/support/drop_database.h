// SPDX-License-Identifier: Apache-2.0
// Databases of simulated drops, made for a test and gone after it, and their graphs.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <utility>

#include "database/journal.h"
#include "dynamics/simulator.h"
#include "graph/contact_graph.h"
#include "sampler/drop_statistics.h"
#include "sampler/event_chain.h"
#include "sampler/initial_state.h"
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
  DropDatabase(const Body& body, std::uint64_t drops, std::uint64_t seed)
      : DropDatabase(body, graphSurface(body), drops, seed) {}
  DropDatabase(const Body& body, const SurfaceProperties& surface, std::uint64_t drops,
               std::uint64_t seed, EventCut kind = EventCut::kAudible) {
    const BodyModel model(body, surface);
    const RecorderSettings cut = recorderFor(kind, body, surface);
    DatabaseHeader header;
    header.identity.simulationVersion = kSimulationVersion;
    header.identity.seed = seed;
    header.identity.allSimulations = header.simulations = drops;
    header.identity.bodyHash = hashOf(body);
    header.identity.settings.mergeGap = cut.mergeGap;
    header.identity.settings.audibleShare = kind == EventCut::kPaper ? 0 : kAudibleShare;
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

}  // namespace ifa::test
