// SPDX-License-Identifier: Apache-2.0
// A synchronised motion: what motion.json holds (docs/file-formats.md).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ifa/event_cut.h"

namespace ifa {

/// Pose and velocities at one instant. World frame, z up, ground at z = 0.
struct MotionSample {
  double time = 0;                                     ///< s after the first contact's start
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< centre of mass, m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< world from body (mesh axes)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s, as played
  Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero();  ///< rad/s, world frame, as played
};

/// Affinity factors (equations 3 to 8, and f_o, f_p of section 6) of the edge that arrives at a
/// contact.
struct ContactFactors {
  double v = 1, q = 1, t = 1, a = 1, l = 1, c = 1, o = 1, p = 1;
};

enum class Arrival { kFlight, kSilentContact };
enum class SourceKind { kSampled, kShot, kDatabase };

/// Where a contact's state comes from.
struct ContactSource {
  SourceKind kind = SourceKind::kShot;
  std::int64_t simulation = 0;
  std::int64_t event = 0;
  int symmetry = 0;
};

/// One contact event of the motion, beside the target that it meets. Times in s after the first
/// contact.
struct MotionContact {
  double targetTime = 0, time = 0;
  double moved = 0;  ///< s by which the target lies after its mark, where that was in doubt
  double targetDuration = 0, duration = 0;  ///< filtered: 0 for discrete events
  double targetAmplitude = 1, amplitude = 1;
  double targetCentroid = 0, centroid = 0;
  double end = 0;  ///< true end of the event
  bool terminal = false;
  Arrival arrival = Arrival::kFlight;
  ContactSource source;
  ContactFactors factors;
  double retiming = 1;  ///< T* / T_b of the edge that arrives
  double bend =
      0;  ///< length of the change at the start of the arriving edge, 1 = edge of plausible
  double restitution = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< centre of mass at the start, m
  Eigen::Vector3d impulseChange =
      Eigen::Vector3d::Zero();  ///< N s, added at the start of the arriving edge
  Eigen::Vector3d angularChange = Eigen::Vector3d::Zero();  ///< N m s, likewise
  /// What the contact's own impulse has to make up for where the body does not arrive with the
  /// velocities it was simulated with, N s and N m s; 0 but for connections.
  Eigen::Vector3d arrivalImpulseChange = Eigen::Vector3d::Zero();
  Eigen::Vector3d arrivalAngularChange = Eigen::Vector3d::Zero();
  double arrivalBend = 0;  ///< its length, 1 = edge of plausible
};

/// Which body on which surface, as used.
struct MotionObject {
  std::string name, mesh, surface;
  double mass = 0, restitution = 0, friction = 0;
};

/// What was asked for, where restitution and surface were fitted to the sound.
struct GivenSurface {
  std::string surface;
  double restitution = 0;
};

/// The sound that the motion is synchronised to.
struct MotionSound {
  std::string file;
  int rate = 0;             ///< Hz
  double duration = 0;      ///< s
  double firstContact = 0;  ///< s in the file
};

struct BendSummary {
  double median = 0, max = 0, cap = 2;
};

/// A direction of the body and where it was asked to point at a contact, or at rest.
struct MotionOrientation {
  int contact = 0;  ///< index into the contacts; -1: where the body rests
  Eigen::Vector3d body = Eigen::Vector3d::UnitZ();   ///< body frame, unit
  Eigen::Vector3d world = Eigen::Vector3d::UnitZ();  ///< unit
};

/// Where a contact was asked to begin: the centre of mass, seen from above.
struct MotionPosition {
  int contact = 0;                                  ///< index into the contacts
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m
};

/// The event database that was used, if any.
struct DatabaseReference {
  std::int64_t simulations = 0, events = 0;
  std::string hash;
};

/// A whole motion with its provenance and scores.
struct Motion {
  std::string program;
  std::uint64_t seed = 0;
  std::string planner;
  std::string settings;  ///< tells apart what was asked for, with what it is compared; may be empty
  MotionObject object;
  std::optional<GivenSurface> given;  ///< only where `object` has a fitted restitution
  MotionSound sound;
  bool success = false;
  std::string failure;  ///< empty when successful
  bool timeLimitReached = false;
  double energyGain = 0;
  double score = 0;              ///< eq. 12
  double scoreWithoutSound = 0;  ///< eq. 13
  double searchSeconds = 0;
  /// "graph": until a motion of Score 0.3 was found, s; negative where none was. Not in the file.
  double secondsToGoodScore = -1;
  BendSummary bend;
  double meanFv = 0;  ///< geometric mean of f_v
  std::optional<DatabaseReference> database;
  EventCut cut = EventCut::kAudible;  ///< what its contacts are, for who looks for them
  std::vector<MotionContact> contacts;
  std::vector<double> dropped;  ///< doubtful marks that no contact meets, s after the first contact
  std::vector<MotionOrientation> orientations;  ///< that were asked for
  std::vector<MotionPosition> positions;        ///< likewise
  std::vector<std::array<double, 2>> silent;    ///< intervals of silent contact, s
  std::vector<MotionSample>
      trajectory;  ///< non-decreasing times; two samples share an impact's time
};

}  // namespace ifa
