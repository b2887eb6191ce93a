// SPDX-License-Identifier: Apache-2.0
#include "planner/path_connector.h"

#include <algorithm>

#include "dynamics/energy.h"
#include "planner/contact_beginning.h"
#include "sampler/drop_statistics.h"

namespace ifa {

namespace {

constexpr double kLongestEvent = 20;  // s
// Decision: rad, of a printed connection. Where the flight ends the pose jumps by that, and with it
// the angular momentum of a long body by several times as much; the audit allows 1e-6 of it.
constexpr double kPoseMissed = 1e-7;

PlanarTransform shiftTo(const RigidState& state) {
  return {1, 0, state.position.x(), state.position.y()};
}

}  // namespace

PathConnector::PathConnector(const PlanRequest& request)
    : graph_(*request.graph),
      model_(*request.body, request.surface),
      recorder_(recorderFor(cutOf(graph_.database().header().identity.settings), *request.body,
                            request.surface)),
      chain_(model_, recorder_) {
  if (graph_.settings().connection == ConnectionKind::kBlend) {
    connection_ = ConnectionSettings::printed();
    connection_.shooting.tolerance = kPoseMissed;
  }
  connection_.depth = request.body->tolerance();
}

const ChainLink& PathConnector::link(std::uint32_t id) {
  const auto known = links_.find(id);
  if (known != links_.end()) return known->second;
  const PackedState before = graph_.database().record(id).before;
  return links_.emplace(id, chain_.follow(before, kLongestEvent)).first->second;
}

bool PathConnector::isSilent(std::uint32_t from, std::uint32_t sibling) const {
  return from == sibling && isLeftInSilence(graph_.database().flags(), from);
}

PlausibleRegion PathConnector::regionOf(std::uint32_t id) {
  const ContactEvent& what = event(id);
  return {what.after.velocity - what.before.velocity,
          what.after.angularVelocity - what.before.angularVelocity, model_.radius,
          graph_.settings().affinity};
}

bool PathConnector::reachable(std::uint32_t id, const ConnectedEdge& edge) {
  const ContactEvent& what = event(id);
  if (totalEnergy(model_, what.after) > edge.arrivalEnergy) return false;
  const ContactBeginning beginning =
      beginningOf(model_, what.before, model_.surface.restitution, what.end);
  return canBegin(model_, recorder_, beginning, edge.arrivalEnergy, edge.arrival.velocity,
                  connection_.depth);
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

Placement PathConnector::placement(std::uint32_t from, std::uint32_t sibling,
                                   std::uint32_t symmetry) {
  if (isSilent(from, sibling)) return {shiftTo(link(from).next), {}};
  const auto [j, k] = graph_.passage(sibling);
  const SymmetryImage& image = graph_.image(symmetry);
  const Registration registration = registerState(image.apply(j.after), event(from).after);
  return {registration.transform.after(shiftTo(image.apply(k.before))), image};
}

ConnectedEdge PathConnector::makeSilent(std::uint32_t from, double time) {
  ConnectedEdge edge;
  const ChainLink& own = link(from);
  // A database may have begun anew on the way there; that cannot be followed.
  const PackedState reached = graph_.database().record(from + 1).before;
  if (!own.heard || !own.followed || !(pack(own.next) == reached)) return edge;
  edge.silent = true;
  edge.connection.departure = own.event.after;
  edge.connection.arrival = edge.connection.target = own.next;
  edge.connection.time = {own.nextStart - own.event.end, time};
  edge.placement = placement(from, from, 0);
  edge.arrival = event(from + 1).before;
  edge.arrival.velocity = own.next.velocity;
  // As the body sees it: seen from another pose, if only by rounding, the spin of a slender body is
  // another angular momentum.
  edge.arrival.angularVelocity =
      edge.arrival.orientation * (own.next.orientation.conjugate() * own.next.angularVelocity);
  weigh(from, from, time, edge);
  edge.feasible = edge.connection.time.amount() < graph_.settings().largestWarp;
  return edge;
}

ConnectedEdge PathConnector::make(std::uint32_t from, std::uint32_t sibling, std::uint32_t symmetry,
                                  double time) {
  if (isSilent(from, sibling)) return makeSilent(from, time);
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
