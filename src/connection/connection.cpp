// SPDX-License-Identifier: Apache-2.0
#include "connection/connection.h"

#include <algorithm>

#include "connection/free_turn.h"
#include "connection/ground_clearance.h"
#include "connection/linear_connection.h"
#include "dynamics/kernel_state.h"

namespace ifa {

namespace {

constexpr double kPrintedTurn = 0.17453292519943295;  // rad, 10 degrees

/// Free flight, not looking at the ground.
RigidState flown(const BodyModel& model, const RigidState& start, double duration) {
  KernelState<double> end = kernelState(start, 0);
  const Spin<double> spin = freeTurn(model, {end.q, end.w}, duration).end;
  end.q = spin.q;
  end.w = spin.w;
  RigidState state = rigidState(end);
  const Eigen::Vector3d gained(0, 0, -kGravity * duration);
  state.position += duration * (start.velocity + 0.5 * gained);
  state.velocity += gained;
  return state;
}

Registration registered(const BodyModel& model, const ConnectionEnds& ends, double duration,
                        RegisterAt where) {
  if (where == RegisterAt::kDeparture) return registerState(ends.sibling, ends.source);
  return registerState(ends.target, flown(model, ends.source, duration));
}

ConnectionFailure cannotBegin(const ConnectionEnds& ends, const TimeWarp& time,
                              double largestWarp) {
  if (!ends.flight) return ConnectionFailure::kNotFlight;
  if (!(time.flightTime > 0) || !(time.shownTime > 0)) return ConnectionFailure::kNoTime;
  return time.amount() < largestWarp ? ConnectionFailure::kNone : ConnectionFailure::kTimeWarp;
}

Eigen::Vector3d firstGuess(const BodyModel& model, const RigidState& source,
                           const RigidState& target, ShootingGuess guess) {
  if (guess == ShootingGuess::kSource) return source.angularVelocity;
  return meanMomentumSpin(model, source.orientation, source.angularVelocity, target.orientation,
                          target.angularVelocity);
}

/// Linear and angular connection from `source` to the registered target. False when the shooting
/// fails.
bool shoot(const BodyModel& model, const RigidState& source, const ConnectionSettings& settings,
           Connection& connection) {
  const double duration = connection.time.flightTime;
  RigidState& departure = connection.departure;
  RigidState& arrival = connection.arrival;
  departure = source;
  arrival = connection.target;
  departure.velocity = linearConnection(source.position, arrival.position, duration);
  arrival.velocity = departure.velocity - Eigen::Vector3d(0, 0, kGravity * duration);
  const AngularConnection angular = angularConnection(
      model, source.orientation, arrival.orientation, duration,
      firstGuess(model, source, connection.target, settings.guess), settings.shooting);
  departure.angularVelocity = angular.angularVelocity;
  arrival.angularVelocity = angular.atEnd;
  connection.steps = angular.steps;
  connection.missed = angular.missed;
  return angular.converged;
}

}  // namespace

ConnectionSettings ConnectionSettings::printed() {
  ConnectionSettings settings;
  settings.kind = ConnectionKind::kBlend;
  settings.guess = ShootingGuess::kMeanMomentum;
  settings.shooting.step = ShootingStep::kSquaredAngle;
  settings.shooting.largestTurn = kPrintedTurn;
  settings.shooting.tolerance = 1e-6;
  return settings;
}

ConnectionEnds connectionEnds(const ContactEvent& i, const ContactEvent& j, const ContactEvent& k) {
  return {i.after, j.after, k.before, k.start - j.end, !i.touchingAfter && !j.touchingAfter};
}

std::string_view describe(ConnectionFailure failure) {
  switch (failure) {
    case ConnectionFailure::kNone:
      return "connected";
    case ConnectionFailure::kNotFlight:
      return "what follows the contact is not a flight";
    case ConnectionFailure::kNoTime:
      return "there is no time between the contacts";
    case ConnectionFailure::kTimeWarp:
      return "the flight's own time is too far from the target";
    case ConnectionFailure::kNotConverged:
      return "no spin leads to the next contact's pose";
    case ConnectionFailure::kUnderGround:
      return "the body would go under the ground";
  }
  return "";
}

Connection connect(const BodyModel& model, const ConnectionEnds& ends, double target,
                   const ConnectionSettings& settings) {
  Connection connection;
  // Only what is blended has a time of its own, and is retimed after it (5.3.2).
  const bool exact = settings.kind == ConnectionKind::kExact;
  connection.time = {exact ? target : ends.time, target};
  connection.failure = cannotBegin(ends, connection.time, settings.largestWarp);
  if (!connection.made()) return connection;
  const double duration = connection.time.flightTime;
  connection.registration = registered(model, ends, duration, settings.registerAt);
  connection.target = connection.registration.transform.apply(ends.target);
  if (!shoot(model, ends.source, settings, connection)) {
    connection.failure = ConnectionFailure::kNotConverged;
    return connection;
  }
  if (const auto under = goesUnder(model, connection.departure, duration, settings.depth)) {
    connection.failure = ConnectionFailure::kUnderGround;
    connection.underAt = *under;
  }
  return connection;
}

RigidState stateAt(const BodyModel& model, const Connection& connection, double t) {
  const TimeWarp& time = connection.time;
  return time.shown(flown(model, connection.departure, time.flightTimeAt(t)));
}

}  // namespace ifa
