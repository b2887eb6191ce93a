// SPDX-License-Identifier: Apache-2.0
#include "planner/look_ahead.h"

#include <algorithm>
#include <limits>

#include "affinity/factors.h"

namespace ifa {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
/// Log weight that an event without a way of its own is put back by.
constexpr double kNoOwnWay = 10;

}  // namespace

LookAhead::LookAhead(const PlanRequest& request, const BodyModel& model)
    : request_(request), graph_(*request.graph), model_(model) {
  const auto heights = graph_.database().values(kBeforeHeight);
  if (!heights.empty()) lowest_ = *std::min_element(heights.begin(), heights.end());
}

/// The height of a body in contact lies between narrow limits, and so does the vertical velocity
/// that its next flight takes: how far the event's own is from it is known beforehand.
void LookAhead::rate(int level, GraphChild& child) const {
  const std::uint32_t event = child.transition.event();
  const EventDatabase& database = graph_.database();
  const auto value = [&](Column column) { return double{database.values(column)[event]}; };
  const auto index = static_cast<std::size_t>(level);
  const auto& events = request_.signature.events;
  const double time = events[index + 1].time - events[index].time - value(kDuration);
  const bool flies = (database.flags()[event] & EventRecord::kTouchingAfter) == 0;
  if (!flies || time <= 0) {
    child.bound = kNothing;
    return;
  }
  if (graph_.settings().velocityReference == VelocityReference::kPrinted) return;
  const double vertical = value(kAfterVelocityZ), height = value(kAfterHeight);
  const Eigen::Vector3d change(value(kAfterVelocityX) - value(kBeforeVelocityX),
                               value(kAfterVelocityY) - value(kBeforeVelocityY),
                               vertical - value(kBeforeVelocityZ));
  const PlausibleRegion region(change, Eigen::Vector3d::Zero(), model_.radius,
                               graph_.settings().affinity);
  const auto cost = [&](double rise) {
    return logVelocity(region.bend({0, 0, rise}, Eigen::Vector3d::Zero()));
  };
  const bool terminal = index + 2 == events.size() && request_.signature.terminal;
  const double even = 0.5 * kGravity * time - vertical;
  const double least = even + (lowest_ - height) / time;
  const double most = even + (model_.radius - height) / time;
  child.bound = cost(std::clamp(0.0, least, most));
  child.worth += ownWay(event, time, terminal).value_or(cost(even) - kNoOwnWay);
}

/// What it would take to follow the event's own flight, in another time: it need not be the best
/// edge, but where it is a good one, there are others like it.
std::optional<double> LookAhead::ownWay(std::uint32_t event, double time, bool terminal) const {
  const auto flags = graph_.database().flags();
  if ((flags[event] & EventRecord::kFollowed) == 0) return {};
  TransitionTarget own;
  own.time = time;
  own.terminal = terminal;
  const ContactEvent from = graph_.event(event);
  const EdgeWeight weight = graph_.edgeWeight({from.before, from.after}, own, event);
  if (!weight.exists()) return {};
  return weight.velocity + weight.timeWarp;
}

}  // namespace ifa
