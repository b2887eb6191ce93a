// SPDX-License-Identifier: Apache-2.0
#include "planner/look_ahead.h"

#include <algorithm>

#include "affinity/factors.h"

namespace ifa {

namespace {

/// Log weight that an event without a way of its own is put back by.
constexpr double kNoOwnWay = 10;

}  // namespace

LookAhead::LookAhead(const PlanRequest& request, const BodyModel& model)
    : request_(request), graph_(*request.graph), nextFlight_(*request.graph, model.radius) {}

void LookAhead::rate(int level, GraphChild& child) const {
  const std::uint32_t event = child.transition.event();
  const auto index = static_cast<std::size_t>(level);
  const auto& events = request_.signature.events;
  const double duration = graph_.database().values(kDuration)[event];
  const double time = events[index + 1].time - events[index].time - duration;
  const NextFlight::Cost next = nextFlight_.cost(event, time);
  TransitionTarget own;
  own.time = time;
  own.terminal = index + 2 == events.size() && request_.signature.terminal;
  const EdgeWeight silence = graph_.silentWeight(own, event);
  child.bound = silence.exists() ? std::max(next.bound, silence.timeWarp) : next.bound;
  if (graph_.settings().velocityReference == VelocityReference::kPrinted) return;
  child.worth +=
      silence.exists() ? silence.timeWarp : ownFlight(event, own).value_or(next.guess - kNoOwnWay);
}

/// What it would take to follow the event's own flight, in another time: it need not be the best
/// edge, but where it is a good one, there are others like it.
std::optional<double> LookAhead::ownFlight(std::uint32_t event, const TransitionTarget& own) const {
  const auto flags = graph_.database().flags();
  if ((flags[event] & EventRecord::kFollowed) == 0) return {};
  const ContactEvent from = graph_.event(event);
  const EdgeWeight weight = graph_.edgeWeight({from.before, from.after}, own, event);
  if (!weight.exists()) return {};
  return weight.velocity + weight.timeWarp;
}

}  // namespace ifa
