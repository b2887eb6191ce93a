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

KernelState<double> LinkListener::begin(const PackedState& before, double timeLimit) {
  recorder_ = EventRecorder(settings_);
  before_ = before;
  timeLimit_ = timeLimit;
  time_ = 0;
  rests_ = false;
  touches_.clear();
  return kernelState(unpack(before), 0);
}

void LinkListener::hear(const Piece& piece) {
  if (piece.did == Advance::kImpact || piece.did == Advance::kContact) {
    touches_.push_back({piece.before.time, piece.state.time});
    recorder_.add(piece.contactStep());
  } else {
    recorder_.elapse(piece.state.time);
  }
  time_ = piece.state.time;
  rests_ = piece.did == Advance::kRest;
}

/// An event that does not begin at once is the next one already.
bool LinkListener::nextHeard() const {
  const auto& events = recorder_.events();
  return events.size() > 1 || (!events.empty() && events[0].start > 0);
}

/// An impact takes no time: one at `from` itself is the end of what was before.
bool LinkListener::touchedBetween(double from, double to) const {
  return std::any_of(touches_.begin(), touches_.end(), [=](const Touch& touch) {
    return touch.end > from + kInstant && touch.begin < to - kInstant;
  });
}

ChainLink LinkListener::link() {
  ChainLink link;
  link.rests = rests_;
  const bool late = !rests_ && !nextHeard();
  const std::vector<ContactEvent> found = recorder_.finish(rests_);
  // What the time limit cut off is not known to its end.
  link.heard = !late && !found.empty() && found[0].start <= 0;
  if (link.heard) {
    link.event = found[0];
    // To the bit what it starts from; the spin was turned into the body's frame and back.
    link.event.before = unpack(before_);
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

ChainLink EventChain::follow(const PackedState& before, double timeLimit) {
  stepper_.start(listener_.begin(before, timeLimit));
  while (listener_.goesOn()) {
    const Advance did = stepper_.advance(Stepper::kNoLimit);
    listener_.hear(stepper_.piece(did));
  }
  return listener_.link();
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

void ChainWriter::begin(const RigidState& start, double timeLimit, std::vector<EventRecord>& out) {
  *this = {};
  out_ = &out;
  state_ = pack(start);
  timeLimit_ = timeLimit;
}

bool ChainWriter::goesOn() const { return !over_ && time_ < timeLimit_ && misses_ < kMostMisses; }

void ChainWriter::add(const ChainLink& link) {
  ++misses_;
  if (link.heard) {
    if (waiting_) joinNext(out_->back(), gap_, way_, silent_);
    out_->push_back(recordOf(link.event));
    out_->back().before = state_;
    waiting_ = true;
    silent_ = false;
    gap_ = -link.event.end;
    way_.setZero();
    misses_ = 0;
  }
  over_ = !link.followed;
  if (over_) return;
  gap_ += link.nextStart;
  way_ += link.next.position.head<2>();
  // What was not heard touched nevertheless.
  silent_ = silent_ || link.silentPassage || !link.heard;
  time_ += link.nextStart;
  state_ = pack(link.next);
}

void EventChain::simulate(const RigidState& start, double timeLimit,
                          std::vector<EventRecord>& out) {
  ChainWriter writer;
  writer.begin(start, timeLimit, out);
  while (writer.goesOn()) writer.add(follow(writer.state(), writer.timeLeft()));
}

}  // namespace ifa
