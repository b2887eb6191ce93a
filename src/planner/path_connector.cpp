// SPDX-License-Identifier: Apache-2.0
#include "planner/path_connector.h"

#include <algorithm>

#include "dynamics/energy.h"
#include "sampler/drop_statistics.h"

namespace ifa {

namespace {

constexpr double kLongestEvent = 20;  // s
constexpr double kBin = 1e-3;         // s, in which impulses are heard (docs/method.md, 2)

PlanarTransform shiftTo(const RigidState& state) {
  return {1, 0, state.position.x(), state.position.y()};
}

}  // namespace

PathConnector::PathConnector(const PlanRequest& request)
    : graph_(*request.graph),
      model_(*request.body, request.surface),
      recorder_(audibleCut(*request.body, request.surface)),
      chain_(model_, recorder_) {
  if (graph_.settings().connection == ConnectionKind::kBlend) {
    connection_ = ConnectionSettings::printed();
  }
  connection_.depth = request.body->tolerance();
}

const ContactEvent& PathConnector::event(std::uint32_t id) {
  const auto known = events_.find(id);
  if (known != events_.end()) return known->second;
  const PackedState before = graph_.database().record(id).before;
  return events_.emplace(id, chain_.follow(before, kLongestEvent).event).first->second;
}

PlausibleRegion PathConnector::regionOf(std::uint32_t id) {
  const ContactEvent& what = event(id);
  return {what.after.velocity - what.before.velocity,
          what.after.angularVelocity - what.before.angularVelocity, model_.radius,
          graph_.settings().affinity};
}

PathConnector::Beginning PathConnector::beginningOf(std::uint32_t id) {
  Stepper stepper(model_);
  stepper.start(kernelState(event(id).before, 0));
  const double until = std::min(kBin, event(id).end);
  Beginning beginning;
  for (bool touched = false;;) {
    const Advance did = stepper.advance(Stepper::kNoLimit);
    const bool touches = did == Advance::kImpact || did == Advance::kContact;
    const Vec<double>& v = stepper.state().velocity;
    if (touches || did == Advance::kRest) {
      beginning.afterBin = {v.x, v.y, v.z};
      beginning.time = stepper.state().time;
      if (!touched) {
        beginning.first = beginning.afterBin;
        beginning.energy = totalEnergy(model_, stepper.state());
      }
      touched = true;
    }
    if (did == Advance::kRest || (touched && stepper.state().time >= until)) return beginning;
  }
}

/// With the first impulse the arriving body gives way to the simulated one. What the arriving one
/// has not got, the contact must not give it, and it must still be heard.
bool PathConnector::reachable(std::uint32_t id, const ConnectedEdge& edge) {
  const Beginning beginning = beginningOf(id);
  const double rounding = model_.mass * kGravity * connection_.depth;
  if (beginning.energy - edge.arrivalEnergy > rounding) return false;
  if (totalEnergy(model_, event(id).after) > edge.arrivalEnergy) return false;
  const Eigen::Vector3d fallen(0, 0, kGravity * beginning.time);
  const double impulse =
      model_.mass * std::max((beginning.first - edge.arrival.velocity).norm(),
                             (beginning.afterBin + fallen - edge.arrival.velocity).norm());
  return impulse - 2 * recorder_.weight * kBin > recorder_.threshold;
}

void PathConnector::weigh(std::uint32_t from, std::uint32_t sibling, double time,
                          ConnectedEdge& edge) {
  const GraphSettings& settings = graph_.settings();
  const ContactEvent& left = event(from);
  const ContactEvent& reached = event(sibling + 1);
  const RigidState& departure = edge.connection.departure;
  edge.bend = regionOf(from).bend(departure.velocity - left.after.velocity,
                                  departure.angularVelocity - left.after.angularVelocity);
  edge.arrivalBend = regionOf(sibling + 1)
                         .bend(reached.before.velocity - edge.arrival.velocity,
                               reached.before.angularVelocity - edge.arrival.angularVelocity);
  edge.departureEnergy = totalEnergy(model_, departure);
  edge.arrivalEnergy = totalEnergy(model_, edge.arrival);
  edge.logVelocity = logVelocity(edge.bend);
  edge.logOrientation = logOrientation(edge.connection.registration.angle,
                                       edge.connection.time.flightTime, settings.affinity);
  edge.logTimeWarp = logTimeWarp(time, edge.connection.time.flightTime, settings.affinity);
}

ConnectedEdge PathConnector::make(std::uint32_t from, std::uint32_t sibling, std::uint32_t symmetry,
                                  double time) {
  ConnectedEdge edge;
  const auto [j, k] = graph_.passage(sibling);
  const ContactEvent& left = event(from);
  const SymmetryImage& image = graph_.image(symmetry);
  const RigidState target = image.apply(k.before);
  edge.connection = connect(
      model_, {left.after, image.apply(j.after), target, k.start - j.end, !left.touchingAfter},
      time, connection_);
  if (!edge.connection.made()) return edge;
  const PlanarTransform& registered = edge.connection.registration.transform;
  edge.placement = {registered.after(shiftTo(target)), image};
  edge.arrival = event(sibling + 1).before;
  edge.arrival.velocity = edge.placement.directionFrom(edge.connection.arrival.velocity);
  edge.arrival.angularVelocity = edge.placement.axialFrom(edge.connection.arrival.angularVelocity);
  weigh(from, sibling, time, edge);
  edge.feasible =
      edge.logVelocity > graph_.settings().leastVelocity && reachable(sibling + 1, edge);
  return edge;
}

const ConnectedEdge& PathConnector::edge(int level, std::uint32_t from, std::uint32_t sibling,
                                         std::uint32_t symmetry, double time) {
  const auto key = std::tuple(level, from, sibling, symmetry);
  const auto known = edges_.find(key);
  if (known != edges_.end()) return known->second;
  return edges_.emplace(key, make(from, sibling, symmetry, time)).first->second;
}

bool PathConnector::energyAllows(std::uint32_t id, const ConnectedEdge* previous,
                                 const ConnectedEdge& next) {
  const double before =
      previous != nullptr ? previous->arrivalEnergy : totalEnergy(model_, event(id).before);
  return ifa::energyAllows(before, next.departureEnergy, graph_.settings().energyGain);
}

}  // namespace ifa
