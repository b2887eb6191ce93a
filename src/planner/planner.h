// SPDX-License-Identifier: Apache-2.0
// The interface of all planners: a signature and a body in, ranked and different plans out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "affinity/factors.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "body/body.h"
#include "connection/placement.h"
#include "graph/contact_graph.h"
#include "ifa/contact_signature.h"
#include "ifa/motion.h"
#include "ifa/result.h"
#include "model/contact_event.h"
#include "model/rigid_state.h"
#include "planner/energy_outlook.h"

namespace ifa {

/// The Score at which the paper's search ends (IFA 5.5, "early exit").
inline constexpr double kGoodScore = 0.3;

/// By how much time may be warped where nothing else helps: the limit of IFA 5.3.2 is 30 %.
inline constexpr double kEasedWarp = 0.29;

/// What the user may set for any planner.
struct PlannerSettings {
  std::uint64_t seed = 1;
  int takes = 1;                   ///< different plans wanted, 1 to 32
  double timeLimitSeconds = 0;     ///< cuts the search off; 0: never
  TimeOf timeOf = TimeOf::kClock;  ///< "graph": whose seconds these are, and the plan's
  double energyGain = 0;           ///< eq. 10 relaxed to E (1 + gain), for music
  /// Share by which what lies between two contacts may be played faster or slower than it was
  /// simulated (IFA 5.3.2). Of "shoot" and "hybrid"; "graph" has its own.
  double timeWarp = 0;
  /// Of "shoot" and "hybrid": by kEasedWarp where nothing is found otherwise.
  bool warpsAtLast = false;
  double bendCap = 2;             ///< no contact may be changed by more
  double effort = 1;              ///< scales the budget of counted work
  bool symmetry = true;           ///< "hybrid": events of the database also stand for their images
  double earlyExit = kGoodScore;  ///< "graph": a motion of this Score ends the search
};

/// That a direction of the body points some way at a contact (IFA section 6): where its event
/// begins, or, at a last one that comes to rest, where the body rests.
struct PlannedOrientation {
  std::size_t target = 0;                            ///< index of the signature's event
  Eigen::Vector3d body = Eigen::Vector3d::UnitZ();   ///< unit, principal frame
  Eigen::Vector3d world = Eigen::Vector3d::UnitZ();  ///< unit
};

/// Where the centre of mass is to be, seen from above, when a contact begins (IFA section 6).
struct PlannedPosition {
  std::size_t target = 0;                           ///< index of the signature's event
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< m
};

struct Plan;

/// What is to be planned.
struct PlanRequest {
  const Body* body = nullptr;
  SurfaceProperties surface;
  std::string surfaceName;  ///< for the motion file
  ContactSignature signature;
  PlannerSettings settings;
  std::vector<PlannedOrientation> orientations;
  std::vector<PlannedPosition> positions;   ///< in order of their targets, one for each at most
  std::optional<EnergyOutlook> outlook;     ///< of body and surface; learnt when not given
  const ContactGraph* graph = nullptr;      ///< of body and surface; "graph" needs it
  const EventDatabase* database = nullptr;  ///< of body and surface; "hybrid" needs it
  /// Whether a complete plan may be taken, judged by others (the audit); the next best is taken
  /// where it may not. Asked of few. Empty: all may.
  std::function<bool(const PlanRequest&, const Plan&)> accepts;

  /// Maps of the body onto itself, principal frame, the first the identity, which make no other
  /// take; empty: the identity alone.
  std::vector<Eigen::Matrix3d> symmetry;

  [[nodiscard]] bool accepted(const Plan& plan) const { return !accepts || accepts(*this, plan); }
};

/// One contact of a plan: the event as simulated, and the change of velocity that leads out of it.
struct PlannedContact {
  int target = 0;          ///< index of the signature's event that it meets
  ContactEvent event;      ///< in its own simulation's time and frame; `before` starts it
  Placement placement;     ///< lays that frame into the plan's world, and says which image is seen
  double time = 0;         ///< start in the plan, s after the first contact
  double moved = 0;        ///< s from the target's mark to the alternative that it meets
  double restitution = 0;  ///< used inside this event
  /// Added to `event.after` before the flight (or silent contact) to the next contact. In the
  /// event's frame, as the next one.
  Eigen::Vector3d velocityChange = Eigen::Vector3d::Zero();         ///< m/s
  Eigen::Vector3d angularVelocityChange = Eigen::Vector3d::Zero();  ///< rad/s
  /// `event.before` less the velocities with which the body really arrives: what the contact has to
  /// make up for besides. 0 but for connections (IFA 5.3.2 meets poses, not velocities).
  Eigen::Vector3d arrivalChange = Eigen::Vector3d::Zero();         ///< m/s
  Eigen::Vector3d arrivalAngularChange = Eigen::Vector3d::Zero();  ///< rad/s
  double relativeAmplitude = 1;
  ContactFactors factors;  ///< of the edge that arrives here
  double bend = 0;         ///< likewise
  double retiming = 1;     ///< T* / T_b of it; 1 unless time is warped
  double arrivalBend = 0;  ///< length of the arrival change, in units of this contact's region
  Arrival arrival = Arrival::kFlight;
  /// The silent contact that leads here goes on from the contact before without a new start, and
  /// `event.before` is where it ends in single precision: so a database has it.
  bool unbroken = false;
  ContactSource source;
};

/// A planned motion, or as much of one as was found.
struct Plan {
  bool solved = false;
  std::string failure;  ///< which contact fails, why, and what would help; empty when solved
  bool timeLimitReached = false;
  double secondsToGoodScore = -1;  ///< "graph": until kGoodScore was reached; negative: it was not
  EventCut cut = EventCut::kAudible;  ///< what its contacts are
  double bendCap = 2;                 ///< what the planner kept all bends under
  /// By which "shoot" and "hybrid" order takes: log of the product of all factors, less what large
  /// bends cost besides.
  double worth = 0;
  double score = 0, scoreWithoutSound = 0, meanFv = 0, bendMedian = 0, bendMax = 0;
  std::vector<PlannedContact> contacts;
};

/// Sets Scores and bends of a plan whose contacts, one for each target, are there.
void sumUp(Plan& plan, const LogScore& log);

/// A target as equations 6 to 8 see it.
[[nodiscard]] inline HeardEvent heardOf(const SignatureEvent& target) {
  return {target.amplitude, target.duration, target.centroid};
}

/// Thread safe: `plan` may be called from several threads.
class Planner {
 public:
  virtual ~Planner() = default;
  /// At least one plan (the best partial one when none is solved), best first.
  /// Errors: kInterrupted when asked to stop before anything was found; kBadInput for an empty
  /// signature.
  [[nodiscard]] virtual Result<std::vector<Plan>> plan(const PlanRequest& request,
                                                       const Progress& progress) const = 0;
};

/// @param name  "hybrid", "shoot" or "graph". Errors: kUsage for another.
[[nodiscard]] Result<std::unique_ptr<Planner>> makePlanner(const std::string& name);

}  // namespace ifa
