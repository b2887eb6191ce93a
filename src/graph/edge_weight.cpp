// SPDX-License-Identifier: Apache-2.0
#include "graph/edge_weight.h"

#include <algorithm>
#include <limits>

#include "connection/linear_connection.h"
#include "connection/registration.h"
#include "connection/time_warp.h"

namespace ifa {

namespace {

using Eigen::Vector3d;

/// Eq. 10's E with velocity `v` and spin `w` (principal frame) at height `h`, J.
double energyOf(const Body& body, const Vector3d& v, const Vector3d& w, double h) {
  return 0.5 * (body.mass * v.squaredNorm() + w.dot(body.principalMoments.cwiseProduct(w))) +
         body.mass * kGravity * h;
}

double energyOf(const Body& body, const RigidState& state) {
  return energyOf(body, state.velocity, state.orientation.conjugate() * state.angularVelocity,
                  state.position.z());
}

/// Post-contact state of j, its pre-contact state over the origin.
RigidState after(const EventRecord& j) {
  RigidState state = unpack(j.after);
  state.position.x() = j.shift[0];
  state.position.y() = j.shift[1];
  return state;
}

}  // namespace

HeardEvent heardEvent(const EventDatabase& database, std::size_t event, double firstAmplitude) {
  const double duration = database.values(kDuration)[event];
  const bool discrete = duration < database.header().identity.settings.mergeGap;
  return {database.values(kAmplitude)[event] / firstAmplitude, discrete ? 0 : duration,
          database.values(kCentroid)[event]};
}

EdgeWeigher::EdgeWeigher(const EventDatabase& database, const Body& body,
                         const GraphSettings& settings, const TransitionSource& source,
                         const TransitionTarget& target)
    : database_(&database),
      body_(&body),
      settings_(&settings),
      source_(&source),
      target_(&target),
      region_(source.after.velocity - source.before.velocity,
              source.after.angularVelocity - source.before.angularVelocity, body.radius,
              settings.affinity),
      energy_(energyOf(body, source.before)) {}

bool isLeftByFlight(std::span<const std::uint8_t> flags, std::size_t event) {
  constexpr std::uint32_t kAsked =
      EventRecord::kFollowed | EventRecord::kSilentPassage | EventRecord::kTouchingAfter;
  const bool hasNext = event + 1 < flags.size();  // else a damaged file
  return hasNext && (flags[event] & kAsked) == EventRecord::kFollowed;
}

bool isLeftInSilence(std::span<const std::uint8_t> flags, std::size_t event) {
  const bool followed = event + 1 < flags.size() && (flags[event] & EventRecord::kFollowed) != 0;
  return followed && !isLeftByFlight(flags, event);
}

EdgeWeight silentWeight(const EventDatabase& database, const GraphSettings& settings,
                        const TransitionTarget& target, std::size_t event) {
  EdgeWeight weight;
  const auto flags = database.flags();
  const double own = database.values(kGap)[event];
  if (!isLeftInSilence(flags, event)) {
    weight.refusal = EdgeRefusal::kNotFlight;
  } else if (((flags[event + 1] & EventRecord::kTerminal) != 0) != target.terminal) {
    weight.refusal = EdgeRefusal::kEnd;
  } else if (!(target.time > 0) || !(own > 0) ||
             !(TimeWarp{own, target.time}.amount() < settings.largestWarp)) {
    weight.refusal = EdgeRefusal::kTime;
  }
  if (!weight.exists()) return weight;
  const AffinityParameters& p = settings.affinity;
  const HeardEvent heard = heardEvent(database, event + 1, target.firstAmplitude);
  weight.timeWarp = logTimeWarp(target.time, own, p);
  weight.amplitude = logAmplitude(target.heard, heard, p);
  weight.duration = logDuration(target.heard, heard, p);
  weight.centroid = logCentroid(target.heard, heard, p);
  return weight;
}

EdgeRefusal EdgeWeigher::refusedUnseen(std::size_t sibling) const {
  const auto flags = database_->flags();
  if (!isLeftByFlight(flags, sibling)) return EdgeRefusal::kNotFlight;
  const bool terminal = (flags[sibling + 1] & EventRecord::kTerminal) != 0;
  if (terminal != target_->terminal) return EdgeRefusal::kEnd;
  const double own = database_->values(kGap)[sibling];
  if (!(target_->time > 0) || !(own > 0)) return EdgeRefusal::kTime;
  const bool warped = settings_->connection == ConnectionKind::kBlend &&
                      !(TimeWarp{own, target_->time}.amount() < settings_->largestWarp);
  return warped ? EdgeRefusal::kTime : EdgeRefusal::kNone;
}

EdgeWeight EdgeWeigher::weigh(std::size_t sibling) const {
  return weigh(sibling, -std::numeric_limits<double>::infinity());
}

EdgeWeight EdgeWeigher::weigh(std::size_t sibling, double least) const {
  EdgeWeight weight;
  weight.refusal = refusedUnseen(sibling);
  if (!weight.exists()) return weight;
  const AffinityParameters& p = settings_->affinity;
  weight.timeWarp = logTimeWarp(target_->time, database_->values(kGap)[sibling], p);
  if (weight.timeWarp >= least) {
    const HeardEvent heard = heardEvent(*database_, sibling + 1, target_->firstAmplitude);
    weight.amplitude = logAmplitude(target_->heard, heard, p);
    weight.duration = logDuration(target_->heard, heard, p);
    weight.centroid = logCentroid(target_->heard, heard, p);
  }
  if (!(weight.total() >= least)) {
    weight.refusal = EdgeRefusal::kTooLow;
    return weight;
  }
  weighMotion(database_->record(sibling), database_->record(sibling + 1), weight);
  if (weight.exists() && !(weight.total() >= least)) weight.refusal = EdgeRefusal::kTooLow;
  return weight;
}

void EdgeWeigher::weighMotion(const EventRecord& j, const EventRecord& k,
                              EdgeWeight& weight) const {
  const RigidState& from = source_->after;
  const RigidState sibling = after(j);
  const double time = settings_->connection == ConnectionKind::kExact ? target_->time : j.gap;
  const Registration registration = registerState(sibling, from);
  const Eigen::Quaterniond turn = registration.transform.turn();
  const Vector3d flown(j.next[0] - sibling.position.x(), j.next[1] - sibling.position.y(), 0);
  Vector3d to = from.position + turn * flown;
  to.z() = k.before.height;
  const Vector3d velocity = linearConnection(from.position, to, time);
  // Decision: a body that is still rising when it comes to k's pose has most likely been through
  // the ground; but not where its spin drives a corner down, as it did when k was simulated.
  const bool rising = velocity.z() - kGravity * time > 0 && !(k.before.velocity[2] > 0);
  if (rising) return void(weight.refusal = EdgeRefusal::kRising);
  // Decision: the spin is j's, as printed; omega_blend is not known yet (5.5, lazy blends).
  const double leaving =
      energyOf(*body_, velocity, sibling.orientation.conjugate() * sibling.angularVelocity,
               from.position.z());
  if (!energyAllows(energy_, leaving, settings_->energyGain))
    return void(weight.refusal = EdgeRefusal::kEnergy);
  const bool printed = settings_->velocityReference == VelocityReference::kPrinted;
  const Vector3d reference = printed ? (turn * sibling.velocity).eval() : from.velocity;
  weight.velocity = logVelocity(
      region_.bend(velocity - reference, from.angularVelocity - turn * sibling.angularVelocity));
  weight.orientation = logOrientation(registration.angle, time, settings_->affinity);
  if (weight.velocity < settings_->leastVelocity) {
    weight.refusal = EdgeRefusal::kVelocity;
  } else if (weight.orientation < settings_->leastOrientation) {
    weight.refusal = EdgeRefusal::kOrientation;
  }
}

}  // namespace ifa
