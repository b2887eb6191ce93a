// SPDX-License-Identifier: Apache-2.0
// Events of a database that a body in flight can be aimed at, in all guises that its symmetry gives
// them. IFA 5.2 to 5.4 by shooting: docs/hybrid.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "affinity/factors.h"
#include "connection/registration.h"
#include "database/database.h"
#include "planner/event_rhythms.h"
#include "planner/flight_timing.h"

namespace ifa {

/// What is to be met, and by what the body is left.
struct AimSource {
  RigidState after;                         ///< post-contact state, left by flight
  const PlausibleRegion* region = nullptr;  ///< of the contact that is left
  double duration = 0;                      ///< of the flight, T*, s
  HeardEvent target;                        ///< as equations 6 to 8 see it
  double firstAmplitude = 1;                ///< of the motion's first event, N s
};

/// An event to aim at, as the body would come to it.
struct Aim {
  std::uint32_t event = 0;  ///< of the database
  int symmetry = 0;         ///< number of the group's element that it is seen under
  PlanarKey key;            ///< its pre-contact state, under that element
  double cost = 0;          ///< log units: changes of velocity on both ends, sound, rhythm
};

/// Candidates for one contact of a signature. Immutable; thread safe. Keeps a reference to the
/// group.
class AimedEvents {
 public:
  /// @param matches  the candidates  @param group  orthogonal matrices, principal frame, the first
  /// the identity; improper ones stand for mirror images of the motion
  AimedEvents(const EventDatabase& database, const std::vector<RhythmMatch>& matches,
              std::span<const Eigen::Matrix3d> group, double radius);

  /// The `count` best by cost, under `most`; at most one guise of an event.
  [[nodiscard]] std::vector<Aim> best(const BodyModel& model, const AimSource& source,
                                      std::size_t count, double most) const;

 private:
  /// An event in its body's own axes.
  struct Candidate {
    std::uint32_t event;
    double rhythm, height;
    double amplitude, duration, centroid;  ///< N s, s filtered, s
    PlanarKey key;
    PlausibleRegion region;
  };
  struct Guise {
    Eigen::Vector3d up;
    std::uint32_t candidate;
    std::uint32_t element;
  };
  struct Query;

  void weigh(const Query& query, const Guise& guise, std::vector<Aim>& found, double most) const;

  std::span<const Eigen::Matrix3d> group_;
  std::vector<Candidate> candidates_;
  std::vector<Guise> guises_;          ///< by cell
  std::vector<std::uint32_t> begins_;  ///< first guise of each cell; one more at the end
};

}  // namespace ifa
