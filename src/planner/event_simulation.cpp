// SPDX-License-Identifier: Apache-2.0
#include "planner/event_simulation.h"

#include <algorithm>

namespace ifa {

namespace {

/// A terminal event that lasts longer is given up, s.
constexpr double kLongestEvent = 8;
/// By then every bin that began within the merge gap is closed, s.
constexpr double kBinSlack = 2.2e-3;
constexpr std::size_t kMostCuts = 24;

}  // namespace

Advance EventSimulation::advance(EventRecorder& recorder) {
  ++pieces_;
  const Advance did = stepper_.advance(Stepper::kNoLimit);
  if (did == Advance::kImpact || did == Advance::kContact) {
    recorder.add(stepper_.contactStep());
  } else {
    recorder.elapse(stepper_.state().time);
  }
  return did;
}

void EventSimulation::outcomes(const RigidState& arrival, double restitution, bool terminal,
                               bool cuts, std::vector<ContactEvent>& out, double mergeGap) {
  out.clear();
  RecorderSettings settings = recorder_;
  if (mergeGap > 0) settings.mergeGap = mergeGap;
  EventRecorder recorder(settings);
  stepper_.start(kernelState(arrival, 0), restitution);
  double end = -1;
  bool ended = false, rest = false;
  while (!ended && !rest && stepper_.state().time < kLongestEvent) {
    const Advance did = advance(recorder);
    rest = did == Advance::kRest;
    const auto& events = recorder.events();
    const double time = stepper_.state().time;
    if (events.empty()) {
      if (time > kBinSlack) return;
      continue;
    }
    if (events[0].start > 0) return;
    if (events[0].end != end) {
      end = events[0].end;
      if (cuts && out.size() < kMostCuts) out.push_back(events[0]);
    }
    ended = events.size() > 1 || (!terminal && time >= end + settings.mergeGap + kBinSlack);
  }
  const std::vector<ContactEvent> events = recorder.finish(rest);
  if (events.empty() || events[0].start > 0) return;
  if (terminal) {
    out.clear();
    if (rest && events.size() == 1) out.push_back(events[0]);
  } else {
    // The last cut is the natural end itself.
    if (!out.empty() && out.back().end == events[0].end) out.pop_back();
    if (!(rest && events.size() == 1)) out.insert(out.begin(), events[0]);
  }
  // To the bit what a replay starts from; on its way through the kernel the spin was turned and
  // back.
  for (ContactEvent& event : out) event.before = arrival;
}

std::vector<double> EventSimulation::rhythm(const RigidState& state, std::size_t count,
                                            double horizon) {
  EventRecorder recorder(recorder_);
  stepper_.start(kernelState(state, 0));
  while (recorder.events().size() <= count && stepper_.state().time < horizon + kBinSlack) {
    const Advance did = advance(recorder);
    if (did == Advance::kRest) break;
  }
  std::vector<double> gaps;
  double last = 0;
  for (const ContactEvent& event : recorder.finish(false)) {
    if (gaps.size() == count || event.start > horizon) break;
    gaps.push_back(event.start - last);
    last = event.start;
  }
  return gaps;
}

std::optional<NextContact> EventSimulation::nextAudible(const RigidState& state, double horizon) {
  EventRecorder recorder(recorder_);
  stepper_.start(kernelState(state, 0));
  NextContact next;
  double firstTouch = 1e9;
  while (stepper_.state().time < horizon + kBinSlack) {
    const Advance did = advance(recorder);
    if (did == Advance::kImpact || did == Advance::kContact) {
      firstTouch = std::min(firstTouch, stepper_.before().time);
    }
    if (!recorder.events().empty()) break;
    if (did == Advance::kRest) return std::nullopt;
  }
  const std::vector<ContactEvent> events = recorder.finish(false);
  if (events.empty()) return std::nullopt;
  next.delay = events[0].start;
  next.silentContact = firstTouch < events[0].start;
  next.state = events[0].before;
  return next;
}

}  // namespace ifa
