// SPDX-License-Identifier: Apache-2.0
// Requests that the tests of the shooting planner share, with budgets small enough for tests.
#pragma once

#include "body/object_file.h"
#include "dynamics/simulator.h"
#include "planner/shooting_planner.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace ifa::test {

/// A search of a tenth of the usual width.
inline ShootingPlannerSettings smallSearch() {
  ShootingPlannerSettings settings;
  settings.firstContacts = 400;
  settings.beam = 40;
  settings.perEnergyBin = 12;
  settings.outlookDrops = 150;
  settings.passes = 2;
  return settings;
}

inline const Body& die() {
  static const Body body = loadObject("d6").value();
  return body;
}

inline PlanRequest requestFor(const Body& body) {
  PlanRequest request;
  request.body = &body;
  request.surface = body.definition.surfaces.at(body.definition.defaultSurface);
  return request;
}

/// What is heard of drop number `index`, exactly.
inline ContactSignature signatureOfDrop(const Body& body, std::uint64_t index) {
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  const DropResult drop = simulateDrop(body, surface, sampleInitialState(body, 1234, index), 10);
  const auto events = eventsOf(drop, audibleCut(body, surface));
  ContactSignature signature;
  for (const ContactEvent& event : events) {
    const double duration = event.filteredDuration(body.definition.mergeGap);
    signature.events.push_back({event.start - events[0].start, duration,
                                event.amplitude / events[0].amplitude,
                                duration > 0 ? event.centroid : 0, 1});
  }
  return signature;
}

/// The first drops of the body whose number of audible events lies within these bounds.
inline std::vector<ContactSignature> signatures(const Body& body, std::size_t count,
                                                std::size_t fewest, std::size_t most) {
  std::vector<ContactSignature> all;
  for (std::uint64_t index = 0; all.size() < count; ++index) {
    const ContactSignature signature = signatureOfDrop(body, index);
    if (signature.events.size() >= fewest && signature.events.size() <= most) {
      all.push_back(signature);
    }
  }
  return all;
}

/// Clicks of the given times and loudness.
inline ContactSignature clicks(const std::vector<SignatureEvent>& events, bool terminal) {
  ContactSignature signature;
  signature.events = events;
  signature.terminal = terminal;
  return signature;
}

}  // namespace ifa::test
