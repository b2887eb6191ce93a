// SPDX-License-Identifier: Apache-2.0
// ShootingWorker: transitions to events of a database (docs/hybrid.md).
#include <algorithm>
#include <cmath>

#include "dynamics/energy.h"
#include "planner/contact_beginning.h"
#include "planner/shooting_worker.h"

namespace ifa {

/// As an event of the database began.
void ShootingWorker::plantEvent(unsigned root, std::uint32_t event) {
  const EventDatabase& database = *problem_.request.database;
  ShootingNode node;
  node.root = root;
  const EventName name = database.nameOf(event);
  Jump none;
  none.source = {SourceKind::kDatabase, static_cast<std::int64_t>(name.simulation),
                 static_cast<std::int64_t>(name.event), 0};
  arrive(node, node, {}, unpack(database.record(event).before), problem_.model.surface.restitution,
         -1e300, none);
}

/// Flies to the poses in which events of the database begin, and on from there both as it arrives
/// and with the velocities that they began with.
void ShootingWorker::shootAimed(const ShootingNode& node, const ShootingNode& child,
                                const PlausibleRegion& region, double duration, double bound) {
  const auto level = static_cast<std::size_t>(child.level);
  const AimSource source = {node.event.after, &region, duration, problem_.targets[level],
                            node.firstAmplitude};
  const double mostEnergy = node.energyBefore * (1 + settings().energyGain);
  const auto tries = static_cast<std::size_t>(problem_.settings.aimedTries);
  for (const Aim& aim :
       problem_.aims[level].best(problem_.model, source, tries, problem_.settings.aimedCost)) {
    ++flights_;
    const auto flight = aimFlight(problem_.model, node.event.after, region, duration, aim.key.up);
    if (!flight || flight->energy > mostEnergy || flight->bend > settings().bendCap ||
        child.worth() + logVelocity(flight->bend) <= bound) {
      continue;
    }
    const auto touch = firstTouch(problem_.model, flight->departure, duration + 1e-3);
    if (!touch || std::abs(touch->time - duration) > kTouchPrecision) continue;
    const Edge edge{flight->velocityChange,
                    flight->angularVelocityChange,
                    flight->bend,
                    Arrival::kFlight,
                    {duration, duration}};
    const EventName name = problem_.request.database->nameOf(aim.event);
    Jump jump;
    jump.source = {SourceKind::kDatabase, static_cast<std::int64_t>(name.simulation),
                   static_cast<std::int64_t>(name.event), aim.symmetry};
    const double restitution = problem_.model.surface.restitution;
    arrive(node, child, edge, touch->state, restitution, bound, jump);
    const Eigen::Quaterniond& turn = touch->state.orientation;
    jump.linear = turn * aim.key.velocity - touch->state.velocity;
    jump.angular = turn * aim.key.angularVelocity - touch->state.angularVelocity;
    arrive(node, child, edge, touch->state, restitution, bound, jump);
  }
}

/// Whether the contact can make up for the velocities with which the body does not arrive. They
/// cost what a change on leaving costs.
bool ShootingWorker::makesUpFor(const Jump& jump, const RigidState& arrival,
                                ShootingNode& ending) const {
  ending.arrivalChange = jump.linear;
  ending.arrivalAngular = jump.angular;
  ending.arrivalBend = regionOf(ending.event).bend(jump.linear, jump.angular);
  ending.log.motion += logVelocity(ending.arrivalBend);
  ending.log.velocity += logVelocity(ending.arrivalBend);
  const double large = std::max(0.0, ending.arrivalBend - problem_.settings.largeBend);
  ending.ugly += problem_.settings.bendAversion * large * large;
  const double energy = totalEnergy(problem_.model, arrival);
  if (ending.arrivalBend > settings().bendCap ||
      totalEnergy(problem_.model, ending.event.after) > energy) {
    return false;
  }
  const ContactBeginning beginning =
      beginningOf(problem_.model, ending.event.before, ending.restitution, ending.event.end);
  return canBegin(problem_.model, problem_.recorder, beginning, energy, arrival.velocity,
                  problem_.request.body->tolerance());
}

}  // namespace ifa
