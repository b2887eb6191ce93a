// SPDX-License-Identifier: Apache-2.0
// Requests to the graph planner: signatures of drops that are in a database, changed a little.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "base/random.h"
#include "body/object_file.h"
#include "graph/contact_graph.h"
#include "planner/graph_planner_settings.h"
#include "planner/planner.h"

namespace ifa::test {

/// How far a signature is changed: s, and share of amplitude.
struct Jitter {
  double time = 1.5e-3, amplitude = 0.1;
};

/// What is heard of `count` events in a row, from `first` on; nothing where so many do not follow.
inline std::optional<ContactSignature> signatureFrom(const ContactGraph& graph, std::size_t first,
                                                     std::size_t count, const Jitter& jitter,
                                                     RandomStream& random) {
  const EventDatabase& database = graph.database();
  ContactSignature signature;
  const double measure = database.record(first).amplitude;
  double time = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const EventRecord record = database.record(i);
    const HeardEvent heard = graph.heard(static_cast<std::uint32_t>(i), measure);
    const bool begins = i == first;
    const double late = begins ? 0 : random.uniform(-jitter.time, jitter.time);
    const double louder = begins ? 1 : random.uniform(1 - jitter.amplitude, 1 + jitter.amplitude);
    signature.events.push_back({time + late, heard.duration, louder * heard.amplitude,
                                heard.duration > 0 ? heard.centroid : 0, 1});
    signature.terminal = record.has(EventRecord::kTerminal);
    if (i + 1 < first + count && !record.has(EventRecord::kFollowed)) return {};
    time += record.duration + record.gap;
  }
  for (std::size_t i = 1; i < count; ++i) {
    if (signature.events[i].time - signature.events[i - 1].time < 0.01) return {};
  }
  return signature;
}

/// `wanted` signatures of `count` events each that begin anywhere, or the last ones of a drop.
inline std::vector<ContactSignature> signaturesOf(const ContactGraph& graph, std::size_t wanted,
                                                  std::size_t count, bool terminal,
                                                  std::uint64_t seed, const Jitter& jitter = {}) {
  std::vector<ContactSignature> all;
  for (std::uint64_t stream = 0; all.size() < wanted && stream < 100000; ++stream) {
    RandomStream random(seed, stream);
    const std::size_t first = random.below(graph.database().events() - count);
    const auto signature = signatureFrom(graph, first, count, jitter, random);
    if (signature && signature->terminal == terminal) all.push_back(*signature);
  }
  EXPECT_EQ(all.size(), wanted) << "of " << count << " events";
  return all;
}

inline const Body& graphDie() {
  static const Body body = loadObject("d6").value();
  return body;
}

inline SurfaceProperties graphDieSurface() {
  return graphDie().definition.surfaces.at(graphDie().definition.defaultSurface);
}

inline PlanRequest graphRequest(const Body& body, const SurfaceProperties& surface,
                                const ContactGraph& graph, ContactSignature signature) {
  PlanRequest request;
  request.body = &body;
  request.surface = surface;
  request.graph = &graph;
  request.signature = std::move(signature);
  return request;
}

/// Searches that are given up soon.
inline GraphPlannerSettings quickGraphSearch() {
  GraphPlannerSettings settings;
  settings.mostQueries = 1500;
  return settings;
}

}  // namespace ifa::test
