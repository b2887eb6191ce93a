// SPDX-License-Identifier: Apache-2.0
#include "sampler/event_chain.h"

#include <algorithm>

namespace ifa {

namespace {

/// Two times closer than this are one time, s.
constexpr double kInstant = 1e-9;
/// A contact that was heard may not be, once it starts anew from rounded numbers: then it goes on
/// to the next that is heard. So many times in a row, before the simulation is left there.
constexpr int kMostMisses = 32;

/// Says how the next event follows.
void joinNext(EventRecord& record, double gap, const Eigen::Vector2d& way, bool silent) {
  record.gap = static_cast<float>(gap);
  record.next = {static_cast<float>(way.x()), static_cast<float>(way.y())};
  record.flags |= EventRecord::kFollowed | (silent ? EventRecord::kSilentPassage : 0U);
}

}  // namespace

/// Takes one step; false at rest.
bool EventChain::listen(EventRecorder& recorder) {
  const Advance did = stepper_.advance(Stepper::kNoLimit);
  if (did == Advance::kImpact || did == Advance::kContact) {
    touches_.push_back({stepper_.before().time, stepper_.state().time});
    recorder.add(stepper_.contactStep());
  } else {
    recorder.elapse(stepper_.state().time);
  }
  return did != Advance::kRest;
}

/// An impact takes no time: one at `from` itself is the end of what was before.
bool EventChain::touchedBetween(double from, double to) const {
  return std::any_of(touches_.begin(), touches_.end(), [=](const Touch& touch) {
    return touch.end > from + kInstant && touch.begin < to - kInstant;
  });
}

ChainLink EventChain::follow(const PackedState& before, double timeLimit) {
  EventRecorder recorder(recorder_);
  touches_.clear();
  stepper_.start(kernelState(unpack(before), 0));
  ChainLink link;
  const auto& events = recorder.events();
  // An event that does not begin at once is the next one already.
  const auto nextHeard = [&] {
    return events.size() > 1 || (!events.empty() && events[0].start > 0);
  };
  while (stepper_.state().time < timeLimit && !link.rests && !nextHeard()) {
    link.rests = !listen(recorder);
  }
  const bool late = !link.rests && !nextHeard();
  const std::vector<ContactEvent> found = recorder.finish(link.rests);
  // What the time limit cut off is not known to its end.
  link.heard = !late && !found.empty() && found[0].start <= 0;
  if (link.heard) {
    link.event = found[0];
    // To the bit what it starts from; the spin was turned into the body's frame and back.
    link.event.before = unpack(before);
  }
  link.followed = !late && found.size() > (link.heard ? 1U : 0U);
  if (!link.followed) return link;
  const ContactEvent& next = found[link.heard ? 1 : 0];
  link.rests = link.event.terminal = false;
  link.nextStart = next.start;
  link.next = next.before;
  link.silentPassage = touchedBetween(link.event.end, next.start);
  return link;
}

EventRecord recordOf(const ContactEvent& event) {
  EventRecord record;
  record.before = pack(event.before);
  record.after = pack(event.after);
  const Eigen::Vector3d shift = event.after.position - event.before.position;
  record.shift = {static_cast<float>(shift.x()), static_cast<float>(shift.y())};
  record.duration = static_cast<float>(event.end - event.start);
  record.amplitude = static_cast<float>(event.amplitude);
  record.centroid = static_cast<float>(event.centroid);
  if (event.terminal) record.flags |= EventRecord::kTerminal;
  if (event.touchingAfter) record.flags |= EventRecord::kTouchingAfter;
  return record;
}

void appendRecords(const std::vector<ContactStep>& steps, const std::vector<ContactEvent>& events,
                   std::vector<EventRecord>& out) {
  for (std::size_t k = 0; k < events.size(); ++k) {
    const ContactEvent& event = events[k];
    out.push_back(recordOf(event));
    if (k + 1 == events.size()) return;
    const ContactEvent& next = events[k + 1];
    const bool silent = std::any_of(steps.begin(), steps.end(), [&](const ContactStep& step) {
      return step.time + step.duration > event.end + kInstant && step.time < next.start - kInstant;
    });
    const Eigen::Vector3d way = next.before.position - event.before.position;
    joinNext(out.back(), next.start - event.end, way.head<2>(), silent);
  }
}

void EventChain::simulate(const RigidState& start, double timeLimit,
                          std::vector<EventRecord>& out) {
  PackedState state = pack(start);
  bool waiting = false, silent = false;  // whether out.back() waits for its next event
  double time = 0, gap = 0;
  Eigen::Vector2d way = Eigen::Vector2d::Zero();
  for (int misses = 0; time < timeLimit && misses < kMostMisses; ++misses) {
    const ChainLink link = follow(state, timeLimit - time);
    if (link.heard) {
      if (waiting) joinNext(out.back(), gap, way, silent);
      out.push_back(recordOf(link.event));
      out.back().before = state;
      waiting = true;
      silent = false;
      gap = -link.event.end;
      way.setZero();
      misses = -1;
    }
    if (!link.followed) return;
    gap += link.nextStart;
    way += link.next.position.head<2>();
    // What was not heard touched nevertheless.
    silent = silent || link.silentPassage || !link.heard;
    time += link.nextStart;
    state = pack(link.next);
  }
}

}  // namespace ifa
