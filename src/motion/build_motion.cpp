// SPDX-License-Identifier: Apache-2.0
#include "motion/build_motion.h"

#include <fmt/format.h>

#include <algorithm>

#include "dynamics/stepper.h"
#include "model/event_record.h"
#include "motion/trajectory_writer.h"

namespace ifa {

namespace {

constexpr double kLongestSettling = 10;  // s after the last contact
constexpr double kLongestBouncing = 2;   // s after a last contact that is not terminal
constexpr double kHold = 0.5;            // s at rest
constexpr double kInstant = 1e-9;        // s

bool sameState(const RigidState& a, const RigidState& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs() &&
         a.velocity == b.velocity && a.angularVelocity == b.angularVelocity;
}

/// State in which the body arrives: as simulated, less what the contact makes up for.
RigidState arrivalOf(const PlannedContact& contact) {
  RigidState state = contact.event.before;
  state.velocity -= contact.arrivalChange;
  state.angularVelocity -= contact.arrivalAngularChange;
  return state;
}

/// State that leaves a contact: as simulated, plus the planned change.
RigidState departureOf(const PlannedContact& contact) {
  RigidState state = contact.event.after;
  state.velocity += contact.velocityChange;
  state.angularVelocity += contact.angularVelocityChange;
  return state;
}

class Builder {
 public:
  Builder(const PlanRequest& request, const Plan& plan, Motion& motion)
      : request_(request),
        plan_(plan),
        motion_(motion),
        model_(*request.body, request.surface),
        stepper_(model_),
        writer_(*request.body, model_, motion) {}

  Result<void> trajectory(double preRoll) {
    before(preRoll);
    for (std::size_t k = 0; k < plan_.contacts.size(); ++k) {
      if (auto good = event(k); !good) return good;
      if (k + 1 < plan_.contacts.size()) {
        if (auto good = passage(k); !good) return good;
      }
    }
    ending();
    return {};
  }

  void contacts() {
    int next = 0;
    for (std::size_t k = 0; k < plan_.contacts.size(); ++k) {
      motion_.contacts.push_back(contact(k));
      for (; next < plan_.contacts[k].target; ++next) {
        const auto dropped = static_cast<std::size_t>(next);
        motion_.dropped.push_back(request_.signature.events[dropped].time);
      }
      ++next;
    }
    orientations();
    positions();
  }

 private:
  void orientations() {
    for (const PlannedOrientation& wish : request_.orientations) {
      const auto met = std::find_if(
          plan_.contacts.begin(), plan_.contacts.end(), [&](const PlannedContact& contact) {
            return static_cast<std::size_t>(contact.target) == wish.target;
          });
      if (met == plan_.contacts.end()) continue;
      const bool rests =
          request_.signature.terminal && wish.target + 1 == request_.signature.events.size();
      motion_.orientations.push_back({rests ? -1 : static_cast<int>(met - plan_.contacts.begin()),
                                      request_.body->bodyFromPrincipal * wish.body, wish.world});
    }
  }

  void positions() {
    for (const PlannedPosition& wish : request_.positions) {
      for (std::size_t k = 0; k < plan_.contacts.size(); ++k) {
        if (static_cast<std::size_t>(plan_.contacts[k].target) != wish.target) continue;
        motion_.positions.push_back({static_cast<int>(k), wish.place});
      }
    }
  }

  /// Backward flight: forward with negated velocities (5.1), to an earlier contact or the
  /// pre-roll's start.
  void before(double preRoll) {
    writer_.place(plan_.contacts[0].placement);
    KernelState<double> back = kernelState(plan_.contacts[0].event.before, 0);
    back.velocity = back.velocity * -1.0;
    back.w = back.w * -1.0;
    double duration = 0;
    while (duration < preRoll) {
      const FlightSegment segment(model_, back, preRoll - duration);
      const double hit = segment.firstTouch();
      back = segment.at(std::min(hit, segment.length()));
      duration = back.time;
      if (hit <= segment.length()) break;
    }
    if (duration < kInstant) return;
    KernelState<double> first = back;
    first.velocity = first.velocity * -1.0;
    first.w = first.w * -1.0;
    writer_.sample(first, -duration);
    writer_.flight(first, -duration, duration);
  }

  [[nodiscard]] double startOf(std::size_t k) const { return plan_.contacts[k].time; }
  [[nodiscard]] double endOf(std::size_t k) const {
    return plan_.contacts[k].time + plan_.contacts[k].event.end;
  }

  static Result<void> differs(std::size_t k, const char* what) {
    return tl::unexpected<Error>({ErrorCode::kInternal,
                                  fmt::format("the replay of contact {} {}", k + 1, what),
                                  {},
                                  "please report this with the input"});
  }

  Result<void> event(std::size_t k) {
    const PlannedContact& contact = plan_.contacts[k];
    const KernelState<double> start = kernelState(contact.event.before, 0);
    writer_.place(contact.placement);
    writer_.sample(kernelState(arrivalOf(contact), 0), startOf(k), contact.retiming);
    stepper_.start(start, contact.restitution);
    const bool met = writer_.run(stepper_, startOf(k), contact.event.end + 1, false,
                                 [&](const Stepper& s, Advance did) {
                                   return (did == Advance::kImpact || did == Advance::kContact) &&
                                          s.state().time > contact.event.end - kInstant &&
                                          sameState(rigidState(s.state()), contact.event.after);
                                 });
    return met ? Result<void>{} : differs(k, "does not end as planned");
  }

  /// What joins contact k to the next: flight, or silence as simulated.
  Result<void> passage(std::size_t k) {
    const RigidState departure = departureOf(plan_.contacts[k]);
    const KernelState<double> start = kernelState(departure, 0);
    const PlannedContact& next = plan_.contacts[k + 1];
    const double duration = startOf(k + 1) - endOf(k);
    writer_.sample(start, endOf(k), next.retiming);
    if (next.arrival == Arrival::kFlight) {
      writer_.flight(start, endOf(k), duration, next.retiming);
      return {};
    }
    if (!next.unbroken) stepper_.start(start);
    const auto arrives = [&](const Stepper& s, Advance) {
      RigidState state = rigidState(s.state());
      if (next.unbroken) state = unpack(pack(state));
      return sameState(state, next.event.before);
    };
    const double begin = next.unbroken ? plan_.contacts[k].event.end : 0;
    const bool met =
        writer_.run(stepper_, endOf(k) - next.retiming * begin,
                    begin + duration / next.retiming + 1e-3, true, arrives, next.retiming);
    if (!met) return differs(k + 1, "is not reached as planned");
    motion_.trajectory.pop_back();  // the event begins with it
    return {};
  }

  /// Settles after the last contact, or bounces on when it was not terminal.
  void ending() {
    const std::size_t last = plan_.contacts.size() - 1;
    const double begin = startOf(last);
    const double limit =
        stepper_.state().time + (request_.signature.terminal ? kLongestSettling : kLongestBouncing);
    // What bounces on may be heard; only what settles is silent, and only then is rest part of it.
    const bool settles = plan_.contacts[last].event.terminal;
    writer_.run(stepper_, begin, limit, settles, [](const Stepper&, Advance) { return false; });
    if (!settles || stepper_.state().time >= limit) return;
    const double rest = begin + stepper_.state().time;
    for (int i = 0; i <= static_cast<int>(kHold * 240); ++i) {
      writer_.sampleAtRest(stepper_.state(), rest + i / 240.0);
    }
  }

  [[nodiscard]] MotionContact contact(std::size_t k) const {
    const PlannedContact& planned = plan_.contacts[k];
    const SignatureEvent& target =
        request_.signature.events[static_cast<std::size_t>(planned.target)];
    const double mergeGap = request_.body->definition.mergeGap;
    MotionContact c;
    c.targetTime = target.time + planned.moved;
    c.moved = planned.moved;
    c.targetDuration = target.duration;
    c.targetAmplitude = target.amplitude;
    c.targetCentroid = target.centroid;
    c.time = planned.time;
    c.duration = planned.event.filteredDuration(mergeGap);
    c.end = endOf(k);
    c.amplitude = planned.relativeAmplitude;
    c.centroid = c.duration > 0 ? planned.event.centroid : 0;
    c.terminal = planned.event.terminal;
    c.arrival = planned.arrival;
    c.source = planned.source;
    c.factors = planned.factors;
    c.retiming = planned.retiming;
    c.bend = planned.bend;
    c.arrivalBend = planned.arrivalBend;
    c.restitution = planned.restitution;
    c.position = planned.placement.apply(planned.event.before).position;
    arrivalChange(planned, c);
    if (k > 0) change(plan_.contacts[k - 1], c);
    return c;
  }

  /// The moments of inertia along the world's axes.
  [[nodiscard]] Eigen::Matrix3d inertiaAt(const Eigen::Quaterniond& orientation) const {
    const Eigen::Matrix3d axes = orientation.toRotationMatrix();
    return axes * request_.body->principalMoments.asDiagonal() * axes.transpose();
  }

  void arrivalChange(const PlannedContact& planned, MotionContact& c) const {
    const Placement& placement = planned.placement;
    const Eigen::Matrix3d inertia = inertiaAt(planned.event.before.orientation);
    c.arrivalImpulseChange = placement.direction(request_.body->mass * planned.arrivalChange);
    c.arrivalAngularChange = placement.axial(inertia * planned.arrivalAngularChange);
  }

  /// The impulse and angular impulse that were added where the edge to this contact begins.
  void change(const PlannedContact& from, MotionContact& c) const {
    const Eigen::Matrix3d inertia = inertiaAt(from.event.after.orientation);
    c.impulseChange = from.placement.direction(request_.body->mass * from.velocityChange);
    c.angularChange = from.placement.axial(inertia * from.angularVelocityChange);
  }

  const PlanRequest& request_;
  const Plan& plan_;
  Motion& motion_;
  BodyModel model_;
  Stepper stepper_;
  TrajectoryWriter writer_;
};

}  // namespace

Result<Motion> buildMotion(const PlanRequest& request, const Plan& plan, double preRoll) {
  Motion motion;
  motion.object.name = request.body->definition.name;
  motion.object.surface = request.surfaceName;
  motion.object.mass = request.body->mass;
  motion.object.restitution = request.surface.restitution;
  motion.object.friction = request.surface.friction;
  motion.success = plan.solved;
  motion.failure = plan.failure;
  motion.timeLimitReached = plan.timeLimitReached;
  motion.secondsToGoodScore = plan.secondsToGoodScore;
  motion.energyGain = request.settings.energyGain;
  motion.score = plan.score;
  motion.scoreWithoutSound = plan.scoreWithoutSound;
  motion.meanFv = plan.meanFv;
  motion.cut = plan.cut;
  motion.bend = {plan.bendMedian, plan.bendMax, plan.bendCap};
  if (plan.contacts.empty()) return motion;
  Builder builder(request, plan, motion);
  builder.contacts();
  if (auto good = builder.trajectory(preRoll); !good) return tl::unexpected(good.error());
  return motion;
}

}  // namespace ifa
