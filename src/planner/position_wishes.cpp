// SPDX-License-Identifier: Apache-2.0
#include "planner/position_wishes.h"

#include <algorithm>
#include <cmath>

#include "affinity/factors.h"

namespace ifa {

namespace {

using Eigen::Vector2d;

Vector2d apply(const PlanarTransform& plane, const Vector2d& point) {
  const Eigen::Vector3d turned = plane.turn() * Eigen::Vector3d(point.x(), point.y(), 0);
  return turned.head<2>() + Vector2d(plane.x, plane.y);
}

Vector2d undo(const PlanarTransform& plane, const Vector2d& point) {
  const Vector2d moved = point - Vector2d(plane.x, plane.y);
  const Eigen::Vector3d turned =
      plane.turn().conjugate() * Eigen::Vector3d(moved.x(), moved.y(), 0);
  return turned.head<2>();
}

/// Brings `from` onto `to` and, where they have a length, the direction `along` onto `onto`.
PlanarTransform laying(const Vector2d& from, const Vector2d& to, const Vector2d& along,
                       const Vector2d& onto) {
  const double cosine = along.dot(onto), sine = along.x() * onto.y() - along.y() * onto.x();
  const double angle = cosine == 0 && sine == 0 ? 0 : std::atan2(sine, cosine);
  PlanarTransform plane{std::cos(angle / 2), std::sin(angle / 2), 0, 0};
  const Vector2d shift = to - apply(plane, from);
  plane.x = shift.x();
  plane.y = shift.y();
  return plane;
}

constexpr double kMostMissed = 0.02;  ///< m

}  // namespace

const PlannedPosition* PositionWishes::wishFor(std::size_t level) const {
  const auto found = std::find_if(request_.positions.begin(), request_.positions.end(),
                                  [&](const PlannedPosition& one) { return one.target == level; });
  return found == request_.positions.end() ? nullptr : &*found;
}

double PositionWishes::share(const PlannedPosition& wish, std::size_t level,
                             double duration) const {
  const auto& events = request_.signature.events;
  const double later = events[wish.target].time - events[level].time;
  const double part = duration / std::max(duration + later, 1e-9);
  const bool stops = request_.signature.terminal && wish.target + 1 == events.size();
  // At rest at the wish, its mean speed is half of what it is at first.
  return stops ? 1 - (1 - part) * (1 - part) : part;
}

std::optional<Vector2d> PositionWishes::place(std::size_t level, const Registered& before,
                                              const LevelFlight& flight) const {
  const auto& positions = request_.positions;
  const auto wish =
      std::find_if(positions.begin(), positions.end(),
                   [level](const PlannedPosition& one) { return one.target >= level; });
  if (before.places == 0 || wish == positions.end()) return {};
  Vector2d goal;
  if (before.places > 1) {
    goal = undo(before.plane, wish->place);
  } else {
    // Only how far it is from the first matters: which way, the registration makes good.
    const Vector2d way = flight.to - before.first;
    if (way.norm() < 1e-9) return {};
    goal = before.first + way.normalized() * (wish->place - positions[0].place).norm();
  }
  if (wish->target == level) return goal;
  return flight.from + share(*wish, level, flight.duration) * (goal - flight.from);
}

double PositionWishes::meet(std::size_t level, const Vector2d& position,
                            Registered& registered) const {
  const PlannedPosition* wish = any() ? wishFor(level) : nullptr;
  if (wish == nullptr) return 0;
  const Vector2d& origin = request_.positions[0].place;
  if (registered.places == 0) {
    registered.first = position;
    registered.plane = laying(position, origin, Vector2d::Zero(), Vector2d::Zero());
  } else if (registered.places == 1) {
    registered.plane =
        laying(registered.first, origin, position - registered.first, wish->place - origin);
  }
  registered.places = std::min(2, registered.places + 1);
  return logPositionWish((apply(registered.plane, position) - wish->place).norm());
}

void PositionWishes::settle(Plan& plan) const {
  if (!any()) return;
  Registered registered;
  for (PlannedContact& contact : plan.contacts) {
    const RigidState before = contact.placement.apply(contact.event.before);
    contact.factors.p = std::exp(
        meet(static_cast<std::size_t>(contact.target), before.position.head<2>(), registered));
  }
  Placement placement;
  placement.plane = registered.plane;
  for (PlannedContact& contact : plan.contacts) {
    contact.placement = placement.after(contact.placement);
  }
}

bool PositionWishes::met(const Plan& settled) {
  const double least = std::exp(logPositionWish(kMostMissed));
  return std::all_of(settled.contacts.begin(), settled.contacts.end(),
                     [&](const PlannedContact& contact) { return contact.factors.p >= least; });
}

}  // namespace ifa
