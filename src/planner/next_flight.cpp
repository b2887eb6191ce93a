// SPDX-License-Identifier: Apache-2.0
#include "planner/next_flight.h"

#include <algorithm>
#include <limits>

namespace ifa {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
/// By which a log f_v may differ because a database keeps single precision.
constexpr double kSingle = 1e-4;

}  // namespace

NextFlight::NextFlight(const ContactGraph& graph, double radius) : graph_(graph), radius_(radius) {
  const auto heights = graph.database().values(kBeforeHeight);
  if (!heights.empty()) lowest_ = *std::min_element(heights.begin(), heights.end());
}

NextFlight::Cost NextFlight::cost(std::uint32_t event, double time) const {
  const EventDatabase& database = graph_.database();
  const auto value = [&](Column column) { return double{database.values(column)[event]}; };
  const bool flies = (database.flags()[event] & EventRecord::kTouchingAfter) == 0;
  if (!flies || time <= 0) return {kNothing, kNothing};
  if (graph_.settings().velocityReference == VelocityReference::kPrinted) return {};
  const double vertical = value(kAfterVelocityZ);
  const Eigen::Vector3d change(value(kAfterVelocityX) - value(kBeforeVelocityX),
                               value(kAfterVelocityY) - value(kBeforeVelocityY),
                               vertical - value(kBeforeVelocityZ));
  const PlausibleRegion region(change, Eigen::Vector3d::Zero(), radius_,
                               graph_.settings().affinity);
  const auto [least, most] = climbs(time, value(kAfterHeight));
  // What else changes may make the rise cheaper: along a slanting axis of the region.
  const double rise = std::clamp(0.0, least - vertical, most - vertical);
  const double bound = logVelocity(rise / region.linearAxes().row(2).norm());
  const Eigen::Vector3d even(0, 0, 0.5 * kGravity * time - vertical);
  return {std::min(0.0, bound + kSingle), logVelocity(region.bend(even, Eigen::Vector3d::Zero()))};
}

/// Least and greatest vertical velocity with which a flight of T* = `time` may begin at `height`.
std::pair<double, double> NextFlight::climbs(double time, double height) const {
  const GraphSettings& settings = graph_.settings();
  const bool warped = settings.connection == ConnectionKind::kBlend;
  const double longest = warped ? time * (1 + settings.largestWarp) : time;
  const double shortest = warped ? time / (1 + settings.largestWarp) : time;
  const double down = lowest_ - height, up = radius_ - height;
  return {0.5 * kGravity * shortest + std::min(down / shortest, down / longest),
          0.5 * kGravity * longest + std::max(up / shortest, up / longest)};
}

}  // namespace ifa
