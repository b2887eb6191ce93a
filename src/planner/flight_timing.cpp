// SPDX-License-Identifier: Apache-2.0
#include "planner/flight_timing.h"

#include <cmath>

#include "dynamics/flight.h"

namespace ifa {

namespace {

using Eigen::Vector3d;

/// The world's vertical seen from the body after a torque-free turn.
struct TurnedUp {
  Vec<double> up, w;
};

TurnedUp turn(const BodyModel& model, const Quat<double>& q, const Vec<double>& w,
              double duration) {
  Spin<double> spin{q, w};
  const double angle = model.isotropic ? 1.0 : model.settings.segmentAngle;
  const double longest = angle / std::max(std::sqrt(dot(w, w)), 1.0);
  const int pieces = static_cast<int>(duration / longest) + 1;
  for (int i = 0; i < pieces; ++i) spin = FreeRotation<double>(model, spin).at(duration / pieces);
  return {Rotation<double>(spin.q).rows[2], spin.w};
}

double heightOf(const BodyModel& model, std::size_t i, const Vec<double>& up) {
  return model.x[i] * up.x + model.y[i] * up.y + model.z[i] * up.z;
}

std::size_t lowestVertex(const BodyModel& model, const Vec<double>& up) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < model.x.size(); ++i) {
    if (heightOf(model, i, up) < heightOf(model, lowest, up)) lowest = i;
  }
  return lowest;
}

Vec<double> vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::optional<TimedFlight> timeFlight(const BodyModel& model, const RigidState& after,
                                      const PlausibleRegion& region, Coordinates wish,
                                      double duration) {
  const KernelState<double> start = kernelState(after, 0);
  const Rotation<double> rotation(start.q);
  const double drop = after.position.z() - 0.5 * kGravity * duration * duration;
  TimedFlight flight;
  const auto turned = [&](const Vector3d& spin) {
    return turn(model, start.q, rotation.transposed(vec(spin)), duration);
  };
  for (int step = 0; step < 2; ++step) {
    region.change(wish, flight.velocityChange, flight.angularVelocityChange);
    const Vector3d spin = after.angularVelocity + flight.angularVelocityChange;
    const TurnedUp now = turned(spin);
    const std::size_t lowest = lowestVertex(model, now.up);
    const double height = heightOf(model, lowest, now.up);
    const double miss = drop + (after.velocity.z() + flight.velocityChange.z()) * duration + height;
    if (std::abs(miss) < 1e-9) break;
    Coordinates slope;
    slope.head<3>() = duration * region.linearAxes().row(2).transpose();
    // A thousandth of a radian by the flight's end: far from rounding, and still linear.
    const double nudge = 1e-3 / duration;
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const TurnedUp other = turned(spin + nudge * Vector3d::Unit(axis));
      gradient[axis] = (heightOf(model, lowest, other.up) - height) / nudge;
    }
    slope.tail<3>() = region.angularAxes().transpose() * gradient;
    wish -= slope * (miss / slope.squaredNorm());
  }
  region.change(wish, flight.velocityChange, flight.angularVelocityChange);
  const TurnedUp now = turned(after.angularVelocity + flight.angularVelocityChange);
  const std::size_t lowest = lowestVertex(model, now.up);
  const double rise = -(drop + heightOf(model, lowest, now.up)) / duration;
  flight.velocityChange.z() = rise - after.velocity.z();
  const Vec<double> upRate = cross(now.up, now.w);
  if (rise - kGravity * duration + heightOf(model, lowest, upRate) >= 0) return std::nullopt;
  flight.bend = region.bend(flight.velocityChange, flight.angularVelocityChange);
  flight.departure = after;
  flight.departure.velocity += flight.velocityChange;
  flight.departure.angularVelocity += flight.angularVelocityChange;
  if (!std::isfinite(flight.bend)) return std::nullopt;
  return flight;
}

std::optional<Touch> firstTouch(const BodyModel& model, const RigidState& departure, double limit) {
  KernelState<double> state = kernelState(departure, 0);
  while (state.time < limit) {
    const FlightSegment segment(model, state, limit - state.time);
    const double hit = segment.firstTouch();
    if (hit <= segment.length()) {
      state = segment.at(hit);
      return Touch{state.time, rigidState(state)};
    }
    state = segment.at(segment.length());
  }
  return std::nullopt;
}

}  // namespace ifa
