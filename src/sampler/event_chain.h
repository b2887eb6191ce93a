// SPDX-License-Identifier: Apache-2.0
// A simulation as a chain of contact events, each of which can be simulated again from what is
// stored of it. docs/database.md.
#pragma once

#include <vector>

#include "dynamics/piece.h"
#include "dynamics/stepper.h"
#include "model/contact_event.h"
#include "model/event_record.h"
#include "sampler/event_recorder.h"

namespace ifa {

/// One piece of a chain: an event, and the way to the next one.
struct ChainLink {
  bool heard = false;          ///< an audible event begins at once
  ContactEvent event;          ///< it; times count from its start, places from where it begins
  bool rests = false;          ///< nothing is heard any more until the body rests
  bool followed = false;       ///< another event is heard; else all below is unset
  double nextStart = 0;        ///< s
  RigidState next;             ///< pre-contact state there
  bool silentPassage = false;  ///< the body touches between the event's end and there
};

/// Hears one link of a chain, piece of motion by piece, whoever makes them.
class LinkListener {
 public:
  explicit LinkListener(const RecorderSettings& settings)
      : settings_(settings), recorder_(settings) {}

  /// Begins a link that lasts `timeLimit` seconds at most. Returns what is to be simulated.
  KernelState<double> begin(const PackedState& before, double timeLimit);
  /// Whether the link goes on.
  [[nodiscard]] bool goesOn() const { return time_ < timeLimit_ && !rests_ && !nextHeard(); }
  void hear(const Piece& piece);
  /// The whole of it, when it does not go on.
  [[nodiscard]] ChainLink link();

 private:
  struct Touch {
    double begin, end;  ///< s
  };

  [[nodiscard]] bool nextHeard() const;
  [[nodiscard]] bool touchedBetween(double from, double to) const;

  RecorderSettings settings_;
  EventRecorder recorder_;
  PackedState before_;
  double timeLimit_ = 0, time_ = 0;
  bool rests_ = false;
  std::vector<Touch> touches_;  ///< impacts and steps in contact of this link
};

/// Joins the links of one simulation to records.
class ChainWriter {
 public:
  /// Begins with a simulation that takes at most `timeLimit` seconds and is appended to `out`.
  void begin(const RigidState& start, double timeLimit, std::vector<EventRecord>& out);
  /// Whether there is another link to follow, from `state()` on for `timeLeft()` seconds.
  [[nodiscard]] bool goesOn() const;
  [[nodiscard]] const PackedState& state() const { return state_; }
  [[nodiscard]] double timeLeft() const { return timeLimit_ - time_; }
  void add(const ChainLink& link);

 private:
  std::vector<EventRecord>* out_ = nullptr;
  PackedState state_;
  double timeLimit_ = 0, time_ = 0, gap_ = 0;
  Eigen::Vector2d way_ = Eigen::Vector2d::Zero();
  bool waiting_ = false, silent_ = false;  ///< waiting: out's last one, for its next event
  bool over_ = false;
  int misses_ = 0;
};

/// Decision: the kernel remembers a little of the steps before (what it pushed with), so a state
/// alone does not give the same bits again. Each link therefore starts anew from the *rounded*
/// pre-contact state: what is stored is exactly what was simulated, and a record is a function of
/// its `before`. Not thread safe; one per thread. The model must outlive it.
class EventChain {
 public:
  EventChain(const BodyModel& model, const RecorderSettings& recorder)
      : listener_(recorder), stepper_(model) {}

  /// Simulates from a stored pre-contact state until the next event is heard, the body rests, or
  /// `timeLimit` (s) has passed. The same bits each time.
  [[nodiscard]] ChainLink follow(const PackedState& before, double timeLimit);

  /// Appends the events of a simulation from `start` to rest, at most `timeLimit` seconds.
  void simulate(const RigidState& start, double timeLimit, std::vector<EventRecord>& out);

 private:
  LinkListener listener_;
  Stepper stepper_;
};

/// The record of an event by itself, not followed by another. Places count from where it begins.
[[nodiscard]] EventRecord recordOf(const ContactEvent& event);

/// Appends the records of an unbroken simulation, each followed by the next. What they store is
/// what was simulated, rounded; from that state alone it is not given again.
/// @param steps  of the whole simulation  @param events  found in them
void appendRecords(const std::vector<ContactStep>& steps, const std::vector<ContactEvent>& events,
                   std::vector<EventRecord>& out);

}  // namespace ifa
