// SPDX-License-Identifier: Apache-2.0
#include "planner/graph_plan.h"

#include <algorithm>
#include <cmath>

#include "planner/orientation_wishes.h"
#include "planner/position_wishes.h"

namespace ifa {

namespace {

class PlanMaker {
 public:
  PlanMaker(const PlanRequest& request, const GraphPath& path, PathConnector& connector)
      : request_(request), graph_(*request.graph), path_(path), connector_(connector) {}

  Plan make() {
    add(0);
    plan_.contacts[0].source.kind = SourceKind::kSampled;
    for (int level = 0; level < path_.last(); ++level) follow(level);
    sumUp(plan_, log_);
    OrientationWishes(request_).settle(plan_);
    PositionWishes(request_).settle(plan_);
    plan_.bendCap = largestBend();
    plan_.cut = cutOf(graph_.database().header().identity.settings);
    return std::move(plan_);
  }

 private:
  /// The event that meets the signature's event `level`, and its sound.
  void add(int level) {
    const std::uint32_t id = path_.event(level);
    const SignatureEvent& target = request_.signature.events[static_cast<std::size_t>(level)];
    PlannedContact contact;
    contact.target = level;
    contact.event = connector_.event(id);
    contact.time = target.time - request_.signature.events[0].time;
    contact.restitution = request_.surface.restitution;
    const HeardEvent heard = graph_.heard(id, path_.firstAmplitude);
    contact.relativeAmplitude = heard.amplitude;
    const EventName name = graph_.database().nameOf(id);
    contact.source = {SourceKind::kDatabase, static_cast<std::int64_t>(name.simulation),
                      static_cast<std::int64_t>(name.event), 0};
    const HeardEvent wanted = heardOf(target);
    const double a = logAmplitude(wanted, heard), l = logDuration(wanted, heard),
                 c = logCentroid(wanted, heard);
    contact.factors.a = std::exp(a);
    contact.factors.l = std::exp(l);
    contact.factors.c = std::exp(c);
    log_.sound += a + l + c;
    plan_.contacts.push_back(std::move(contact));
  }

  /// The edge that leaves the event of `level`, and the event that it reaches.
  void follow(int level) {
    const GraphEdge& step = path_.edges[static_cast<std::size_t>(level)];
    const ConnectedEdge& edge =
        connector_.edge(level, path_.event(level), step.sibling, step.symmetry, step.time);
    PlannedContact& from = plan_.contacts.back();
    from.velocityChange = edge.connection.departure.velocity - from.event.after.velocity;
    from.angularVelocityChange =
        edge.connection.departure.angularVelocity - from.event.after.angularVelocity;
    const Placement placement = from.placement.after(edge.placement);
    const auto image = static_cast<std::size_t>(from.source.symmetry);
    add(level + 1);
    PlannedContact& to = plan_.contacts.back();
    to.placement = placement;
    to.source.symmetry = static_cast<int>(graph_.symmetry().product(step.symmetry, image));
    to.arrivalChange = to.event.before.velocity - edge.arrival.velocity;
    to.arrivalAngularChange = to.event.before.angularVelocity - edge.arrival.angularVelocity;
    to.bend = edge.bend;
    to.arrivalBend = edge.arrivalBend;
    to.retiming = edge.connection.time.stretch();
    if (edge.silent) to.arrival = Arrival::kSilentContact;
    to.unbroken = edge.silent;
    weigh(step, edge, to);
  }

  void weigh(const GraphEdge& step, const ConnectedEdge& edge, PlannedContact& to) {
    const bool printed = graph_.settings().velocityReference == VelocityReference::kPrinted;
    const double v = printed ? step.weight.velocity : edge.logVelocity;
    to.factors.v = std::exp(v);
    to.factors.q = std::exp(edge.logOrientation);
    to.factors.t = std::exp(edge.logTimeWarp);
    log_.velocity += v;
    log_.motion += v + edge.logOrientation + edge.logTimeWarp;
  }

  /// Cuts of this planner are of its own kind (-10 of log f_v; as printed that bounds no bend).
  [[nodiscard]] double largestBend() const {
    double largest = std::sqrt(-graph_.settings().leastVelocity);
    for (const PlannedContact& contact : plan_.contacts) {
      largest = std::max({largest, contact.bend, contact.arrivalBend});
    }
    return 0.1 * std::ceil(10 * largest + 1e-6);
  }

  const PlanRequest& request_;
  const ContactGraph& graph_;
  const GraphPath& path_;
  PathConnector& connector_;
  LogScore log_;
  Plan plan_;
};

}  // namespace

Plan planOf(const PlanRequest& request, const GraphPath& path, PathConnector& connector) {
  return PlanMaker(request, path, connector).make();
}

}  // namespace ifa
