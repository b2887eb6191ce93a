// SPDX-License-Identifier: Apache-2.0
// Motion connections: the flight that leads from a contact of one simulation to a contact of
// another. IFA 5.3, docs/connections.md.
#pragma once

#include <string_view>

#include "connection/angular_connection.h"
#include "connection/registration.h"
#include "connection/time_warp.h"
#include "model/contact_event.h"

namespace ifa {

/// How a connection meets its target time.
enum class ConnectionKind {
  /// Solved for T* itself: the flight is exactly ballistic and no time is warped. The default.
  kExact,
  /// As printed: solved for T_j, then shown at another pace.
  kBlend,
};

/// Which states are laid over one another.
enum class RegisterAt {
  kArrival,    ///< the target's pre-contact state over where the source's own flight leads
  kDeparture,  ///< as printed: the post-contact states i+ and j+
};

/// Where the shooting starts.
enum class ShootingGuess {
  kSource,        ///< the source's own spin, omega_{i+}: finds the nearest to what was simulated
  kMeanMomentum,  ///< as printed: (L_{i+} + L_{k-}) / 2
};

struct ConnectionSettings {
  ConnectionKind kind = ConnectionKind::kExact;
  RegisterAt registerAt = RegisterAt::kDeparture;
  ShootingGuess guess = ShootingGuess::kSource;
  ShootingSettings shooting;
  double largestWarp = 0.3;  ///< T_eval of eq. 5 must stay below; 5.3.2
  double depth = 1e-4;       ///< m the body may sink in flight; Body::tolerance() where it is known

  /// As 5.3.2 has it, but for exact slopes.
  [[nodiscard]] static ConnectionSettings printed();
};

/// What is to be joined: contact i of one simulation with contact k = j + 1 of another, in which j
/// is like i.
struct ConnectionEnds {
  RigidState source;   ///< i+: post-contact
  RigidState sibling;  ///< j+: post-contact; where the target's simulation came from
  RigidState target;   ///< k-: pre-contact
  double time = 0;     ///< T_j: from j+ to k-, s
  bool flight = true;  ///< false where silent contact, not flight, follows i or j
};
[[nodiscard]] ConnectionEnds connectionEnds(const ContactEvent& i, const ContactEvent& j,
                                            const ContactEvent& k);

/// Why there is no connection.
enum class ConnectionFailure {
  kNone,
  kNotFlight,     ///< one of the passages is silent contact: it is followed as simulated
  kNoTime,        ///< a time is not above 0
  kTimeWarp,      ///< T_j is too far from T*
  kNotConverged,  ///< Newton's method found no spin
  kUnderGround,   ///< the body would sink into the ground on its way
};
/// A few words for people.
[[nodiscard]] std::string_view describe(ConnectionFailure failure);

/// A connection, or why there is none; what was not reached stays 0.
struct Connection {
  ConnectionFailure failure = ConnectionFailure::kNone;
  Registration registration;  ///< lays the target's simulation into the source's world
  RigidState departure;       ///< i+ with v_blend and omega_blend: where the flight starts
  RigidState arrival;         ///< its end: pose of the registered target, velocities of the flight
  RigidState target;          ///< the registered target, with its simulated velocities
  TimeWarp time;              ///< of flight, and shown; the same for an exact connection
  int steps = 0;              ///< Newton steps
  double missed = 0;          ///< angle left by them, rad
  double underAt = 0;         ///< s of flight after which the body sinks, for kUnderGround

  [[nodiscard]] bool made() const { return failure == ConnectionFailure::kNone; }
};

/// Connects the ends so that contact k comes `target` seconds (T*) after contact i is left. Thread
/// safe; microseconds to some hundred, more where Newton fails, so leave it until a path is chosen
/// (5.5, lazy blends).
[[nodiscard]] Connection connect(const BodyModel& model, const ConnectionEnds& ends, double target,
                                 const ConnectionSettings& settings = {});

/// State that is seen `t` seconds (0 to time.shownTime) after the start of a connection that was
/// made, with the velocities that are seen.
[[nodiscard]] RigidState stateAt(const BodyModel& model, const Connection& connection, double t);

}  // namespace ifa
