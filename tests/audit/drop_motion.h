// SPDX-License-Identifier: Apache-2.0
// A simulated drop as a motion: what the simulator does by itself, without any planner.
#pragma once

#include <algorithm>
#include <cmath>

#include "audit/flight.h"
#include "dynamics/simulator.h"
#include "ifa/motion.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace ifa::test {

/// Turns a drop into a motion by the contract's rules.
class DropMotion {
 public:
  DropMotion(const Body& body, const SurfaceProperties& surface, const DropResult& drop,
             EventCut cut)
      : body_(body) {
    const auto events = eventsOf(drop, recorderFor(cut, body, surface));
    motion.cut = cut;
    listContacts(events);
    record(drop.steps.front().time, drop.steps.front().before);
    for (const ContactStep& step : drop.steps) {
      flyTo(step.time, step.before);
      record(step.time + step.duration, step.after);
    }
    RigidState rest = drop.rest;
    rest.velocity.setZero();
    rest.angularVelocity.setZero();
    for (int i = 0; i < 20; ++i) record(drop.restTime + i / 240.0, rest);
    listSilence(drop);
    motion.object = {
        body.definition.name, "", body.definition.defaultSurface, body.mass, surface.restitution,
        surface.friction};
    motion.success = true;
    motion.bend.cap = 2;
    fixSigns();
  }

  Motion motion;

 private:
  void listContacts(const std::vector<ContactEvent>& events) {
    for (const ContactEvent& event : events) {
      MotionContact contact;
      contact.targetTime = contact.time = event.start;
      contact.end = event.end;
      contact.terminal = event.terminal;
      contact.position = event.before.position;
      motion.contacts.push_back(contact);
    }
  }
  void record(double time, const RigidState& state) {
    MotionSample sample;
    sample.time = time;
    sample.position = state.position;
    sample.orientation =
        state.orientation * Eigen::Quaterniond(body_.bodyFromPrincipal.transpose());
    sample.orientation.normalize();
    sample.velocity = state.velocity;
    sample.angularVelocity = state.angularVelocity;
    motion.trajectory.push_back(sample);
  }
  /// The audit's own flight in between: where the simulator ends it must agree.
  void flyTo(double time, const RigidState& state) {
    const double gap = time - motion.trajectory.back().time;
    const double steps = std::ceil(gap / 1e-3);
    for (double i = 1; i < steps; ++i) {
      motion.trajectory.push_back(
          audit_detail::flyFreely(motion.trajectory.back(), gap / steps, kGravity, body_.inertia));
    }
    if (gap > 0) record(time, state);
  }
  void listSilence(const DropResult& drop) {
    const auto& contacts = motion.contacts;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const double from = contacts[i].end;
      const double to = i + 1 < contacts.size() ? contacts[i + 1].time : drop.restTime;
      const bool touches =
          std::any_of(drop.steps.begin(), drop.steps.end(), [&](const ContactStep& step) {
            return step.time >= from && step.time + step.duration <= to;
          });
      if (touches) motion.silent.push_back({from, to});
    }
  }
  void fixSigns() {
    for (std::size_t i = 1; i < motion.trajectory.size(); ++i) {
      auto& q = motion.trajectory[i].orientation;
      if (q.dot(motion.trajectory[i - 1].orientation) < 0) q.coeffs() *= -1;
    }
  }

  const Body& body_;
};

/// Drop number `index` of `body` on its default surface.
inline Motion makeDropMotion(const Body& body, std::uint64_t index,
                             EventCut cut = EventCut::kAudible) {
  const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
  const auto drop = simulateDrop(body, surface, sampleInitialState(body, 7, index), 20);
  return DropMotion(body, surface, drop, cut).motion;
}

}  // namespace ifa::test
