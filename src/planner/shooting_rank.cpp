// SPDX-License-Identifier: Apache-2.0
// How partial motions of guided shooting are ranked, and what the way to the next contact is worth.
#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "planner/shooting_worker.h"

namespace ifa {

/// Ranks a motion by its score so far, the cost of the next step, and whether its energy suits what
/// follows.
void ShootingWorker::judge(ShootingNode& node) const {
  node.rank = node.worth();
  const auto k = static_cast<std::size_t>(node.level);
  if (k + 1 >= problem_.targets.size()) return;
  node.rank -= problem_.settings.lookAheadWeight * lookAhead(node);
  EnergyOutlook::Features features = problem_.features[k];
  features[4] += portableLog(node.firstAmplitude);
  const double off = std::abs(problem_.outlook.deviation(node.energyAfter, features)) - 1;
  if (off > 0) node.rank -= problem_.settings.outlookWeight * off * off;
}

/// Log units that the motion would lose on its way to the next target, or to another moment at
/// which that may begin, or, where it may be left out, to the one after it.
double ShootingWorker::lookAhead(ShootingNode& node) const {
  const auto& events = problem_.request.signature.events;
  const int level = node.level + 1;
  const SignatureEvent& target = events[static_cast<std::size_t>(level)];
  const Way next = wayTo(node, level, target.time);
  node.flightCost = next.flightCost;
  node.silentOff = next.silentOff;
  double cost = next.cost;
  for (const AlternativeStart& other : target.alternatives) {
    if (other.cost < cost) cost = std::min(cost, other.cost + wayTo(node, level, other.time).cost);
  }
  const double dropped = droppedBetween(node.level, level + 1);
  const bool last = level + 1 == static_cast<int>(events.size());
  if (target.weight < 1 && !last && dropped < cost) {
    const double time = events[static_cast<std::size_t>(level + 1)].time;
    cost = std::min(cost, dropped + wayTo(node, level + 1, time).cost);
  }
  return cost;
}

/// With the smallest change that flies there at `time`, or, where the motion does not just fly, by
/// how far it misses that time unchanged.
auto ShootingWorker::wayTo(const ShootingNode& node, int level, double time) const -> Way {
  const double hopeless = problem_.settings.hopeless;
  const double duration = time - node.start - node.event.end;
  Way way;
  if (duration < shortestPassage()) return {0, ShootingNode::kNotSilent, 2 * hopeless};
  way.flightCost = flightCost(node, level, duration);
  for (const double off : {-slack(duration), slack(duration)}) {
    if (settings().timeWarp <= 0 || way.flightCost < 1) break;
    const double flown = duration + off,
                 warp = -problem_.settings.warpWeight * logTimeWarp(duration, flown);
    way.flightCost = std::min(way.flightCost, warp + flightCost(node, level, flown));
  }
  way.cost = way.flightCost;
  if (way.flightCost < 1) return way;
  const double horizon = silentHorizon(duration);
  const auto next = simulation_.nextAudible(node.event.after, horizon);
  if (next && !next->silentContact) {
    way.cost = std::min(way.flightCost, hopeless);
    return way;
  }
  const double delay = next ? std::min(next->delay, horizon) : horizon;
  const double missed = std::abs(delay - duration);
  way.silentOff = (settings().timeWarp > 0 ? std::max(0.0, missed - slack(duration)) : missed) /
                  std::max(0.004, 0.1 * duration);
  way.cost = std::min({hopeless, way.flightCost, 0.5 + way.silentOff * way.silentOff});
  return way;
}

/// Horizontal velocity that takes a flight towards the place that target `level` or a later one
/// asks for, nothing where none does: as far that way as costs least in f_v and f_p together, times
/// `eager`.
std::optional<Eigen::Vector2d> ShootingWorker::steeredTo(const ShootingNode& node, int level,
                                                         const PlausibleRegion& region,
                                                         double duration, double eager) const {
  const Eigen::Vector2d as = node.event.after.velocity.head<2>();
  const Eigen::Vector2d from = node.event.after.position.head<2>();
  const LevelFlight flight = {from, from + duration * as, duration};
  const auto place =
      problem_.places.place(static_cast<std::size_t>(level), node.registered, flight);
  if (!place) return {};
  const Eigen::Vector2d off = *place - flight.to;
  const Eigen::Vector3d change(off.x() / duration, off.y() / duration, 0);
  const double bend = region.bend(change, Eigen::Vector3d::Zero());
  const double bent = bend * bend, missed = -logPositionWish(off.norm());
  if (missed < 1e-12) return as;
  const double share = std::min(1.0, eager * missed / (bent + missed));
  return as + share * change.head<2>();
}

double ShootingWorker::flightCost(const ShootingNode& node, int level, double duration) const {
  const double mostEnergy = node.energyBefore * (1 + settings().energyGain);
  const PlausibleRegion region = regionOf(node.event);
  ++flights_;
  const auto flight = timeFlight(problem_.model, node.event.after, region, Coordinates::Zero(),
                                 duration, mostEnergy, steeredTo(node, level, region, duration, 1));
  if (!flight) return problem_.settings.hopeless;
  const bool allowed = flight->energy <= mostEnergy;
  const auto touch = firstTouch(problem_.model, flight->departure, duration + 1e-3);
  const bool clear = touch && std::abs(touch->time - duration) < kTouchPrecision;
  double cost = -logVelocity(flight->bend) + (allowed ? 0 : 2) + (clear ? 0 : 2);
  if (touch) {
    const double wished =
        problem_.wishes.logAtStart(static_cast<std::size_t>(level), touch->state.orientation);
    Registered registered = node.registered;
    const double placed = problem_.places.meet(static_cast<std::size_t>(level),
                                               touch->state.position.head<2>(), registered);
    cost += std::min(problem_.settings.restless, -wished - placed);
  }
  return closes(level) && touch ? cost + endingCost(node, touch->state) : cost;
}

/// Log units lost by the last event if it began at `arrival`, as far as that is bearable.
double ShootingWorker::endingCost(const ShootingNode& node, const RigidState& arrival) const {
  std::vector<ContactEvent> endings;
  simulation_.outcomes(arrival, problem_.model.surface.restitution, true, false, endings,
                       mergeGapOf(problem_.targets.size() - 1));
  const double restless = problem_.settings.restless;
  if (endings.empty()) return restless;
  const HeardEvent heard = heardOf(endings[0], node.firstAmplitude);
  const HeardEvent& target = problem_.targets.back();
  const double wished = problem_.wishes.log(problem_.targets.size() - 1, endings[0]);
  return std::min(restless, -(logAmplitude(target, heard) + logDuration(target, heard) +
                              logCentroid(target, heard) + wished));
}

}  // namespace ifa
