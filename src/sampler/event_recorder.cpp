// SPDX-License-Identifier: Apache-2.0
#include "sampler/event_recorder.h"

#include <algorithm>
#include <cmath>

namespace ifa {

namespace {

/// Impulses are summed over this time by definition, whatever the solver's step (docs/method.md 2).
constexpr double kBin = 1e-3;
/// Two times closer than this are one time.
constexpr double kInstant = 1e-9;

double excess(const ContactStep& bin, const RecorderSettings& settings) {
  return settings.excess(bin.impulse.norm(), bin.duration);
}

}  // namespace

double RecorderSettings::excess(double impulse, double duration) const {
  if (!audible) return impulse;
  return std::max(0.0, impulse - 2 * weight * std::max(kBin, duration));
}

void EventRecorder::add(const ContactStep& step) {
  if (open_) {
    const bool over = step.time >= bin_.time + kBin - kInstant;
    // An impact begins a bin of its own, so that an event starts exactly where it is heard.
    const bool fresh = step.duration <= 0 && !settings_.counts(heard());
    if (over || fresh) closeBin();
  }
  if (!open_) {
    bin_ = step;
    loudest_ = excess(step, settings_);
    open_ = true;
    return;
  }
  // What is heard by itself is heard, whatever the rest of its bin adds up to.
  loudest_ = std::max(loudest_, excess(step, settings_));
  bin_.impulse += step.impulse;
  bin_.duration = step.time + step.duration - bin_.time;
  bin_.after = step.after;
  bin_.touching = step.touching;
}

double EventRecorder::heard() const { return std::max(loudest_, excess(bin_, settings_)); }

void EventRecorder::elapse(double time) {
  if (open_ && time >= bin_.time + kBin - kInstant) closeBin();
}

void EventRecorder::closeBin() {
  open_ = false;
  largest_ = std::max(largest_, bin_.impulse.norm());
  const double heard = this->heard();
  if (!settings_.counts(heard)) return;
  if (events_.empty() || bin_.time - events_.back().end >= settings_.mergeGap) {
    ContactEvent event;
    event.start = bin_.time;
    event.before = bin_.before;
    events_.push_back(event);
    square_ = sum_ = moment_ = 0;
  }
  ContactEvent& event = events_.back();
  square_ += heard * heard;
  sum_ += heard;
  moment_ += heard * (bin_.time - event.start);
  event.end = bin_.time + bin_.duration;
  event.after = bin_.after;
  event.touchingAfter = bin_.touching;
  event.amplitude = std::sqrt(square_);
  event.centroid = moment_ / sum_;
}

std::vector<ContactEvent> EventRecorder::finish(bool atRest) {
  if (open_) closeBin();
  if (atRest && !events_.empty()) events_.back().terminal = true;
  return events_;
}

}  // namespace ifa
