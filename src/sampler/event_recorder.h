// SPDX-License-Identifier: Apache-2.0
// Finds audible contact events in a row of contact steps (IFA section 4, docs/method.md 2).
#pragma once

#include <vector>

#include "model/contact_event.h"
#include "model/contact_step.h"

namespace ifa {

/// How impulses become events.
struct RecorderSettings {
  double mergeGap = 0.010;  ///< delta t of IFA section 4: smaller gaps are closed, s
  double weight = 0;        ///< m g, N; twice this share of a bin is what carries the body quietly
  double threshold = 0;     ///< N s; a bin whose excess is not above this is not heard
  /// Decision: events are audible events. False takes the paper's own cut, any impulse above zero.
  bool audible = true;

  /// What counts of an impulse (N s) that took `duration` (s) or a bin of 1 ms; N s.
  [[nodiscard]] double excess(double impulse, double duration) const;
  /// Whether an event is made of an excess (N s).
  [[nodiscard]] bool counts(double excess) const { return excess > (audible ? threshold : 0.0); }
};

/// Takes the steps of one simulation in order of time; ask for the events at the end.
class EventRecorder {
 public:
  explicit EventRecorder(const RecorderSettings& settings) : settings_(settings) {}

  void add(const ContactStep& step);
  /// Tells that nothing was added until `time`; closes a bin that is over by then.
  void elapse(double time);
  /// Events so far, without what the open bin may add.
  [[nodiscard]] const std::vector<ContactEvent>& events() const { return events_; }
  /// Closes the last event, marks it terminal when `atRest`, and returns all events.
  [[nodiscard]] std::vector<ContactEvent> finish(bool atRest);
  /// Largest impulse in one bin so far, N s.
  [[nodiscard]] double largestImpulse() const { return largest_; }

 private:
  void closeBin();
  [[nodiscard]] double heard() const;  ///< excess of the open bin, N s

  RecorderSettings settings_;
  std::vector<ContactEvent> events_;
  ContactStep bin_;  ///< the 1 ms bin that is being filled
  bool open_ = false;
  double loudest_ = 0;                        ///< excess of one step in it, N s
  double square_ = 0, sum_ = 0, moment_ = 0;  ///< of the current event's excess impulses
  double largest_ = 0;
};

}  // namespace ifa
