// SPDX-License-Identifier: Apache-2.0
#include "planner/flight_timing.h"

#include <cmath>

#include "dynamics/flight.h"

namespace ifa {

namespace {

using Eigen::Vector3d;

/// Orientation and spin after a torque-free turn.
struct TurnedUp {
  Rotation<double> rotation;
  Vec<double> w;

  [[nodiscard]] const Vec<double>& up() const { return rotation.rows[2]; }
};

TurnedUp turn(const BodyModel& model, const Quat<double>& q, const Vec<double>& w,
              double duration) {
  Spin<double> spin{q, w};
  const double rate = std::sqrt(dot(w, w));
  const int pieces =
      closedForm(model) ? 1 : static_cast<int>(duration * rate / model.settings.segmentAngle) + 1;
  for (int i = 0; i < pieces; ++i) spin = FreeRotation<double>(model, spin).at(duration / pieces);
  return {Rotation<double>(spin.q), spin.w};
}

/// Transpose of the left Jacobian of the rotation by `v`, applied to `a`: how a change of the
/// constant spin turns the body by the flight's end. Exact for equal moments, near enough to aim
/// with for others.
Vec<double> aimed(const Vec<double>& v, const Vec<double>& a) {
  const double angle2 = dot(v, v), angle = std::sqrt(angle2);
  if (angle < 1e-3) return a - cross(v, a) * 0.5;
  const SinCos<double> turned = laneSinCos(angle);
  const double c = (1 - turned.cosine) / angle2, s = turned.sine / angle;
  return a * s - cross(v, a) * c + v * (dot(v, a) * (1 - s) / angle2);
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
    const std::size_t lowest = lowestVertex(model, now.up());
    const double height = heightOf(model, lowest, now.up());
    const double miss = drop + (after.velocity.z() + flight.velocityChange.z()) * duration + height;
    if (std::abs(miss) < 1e-9) break;
    Coordinates slope;
    slope.head<3>() = duration * region.linearAxes().row(2).transpose();
    const Vec<double> r =
        now.rotation * Vec<double>{model.x[lowest], model.y[lowest], model.z[lowest]};
    const Vec<double> lever = aimed(vec(spin) * duration, {r.y * duration, -r.x * duration, 0});
    slope.tail<3>() = region.angularAxes().transpose() * Vector3d(lever.x, lever.y, lever.z);
    wish -= slope * (miss / slope.squaredNorm());
  }
  region.change(wish, flight.velocityChange, flight.angularVelocityChange);
  const TurnedUp now = turned(after.angularVelocity + flight.angularVelocityChange);
  const std::size_t lowest = lowestVertex(model, now.up());
  const double rise = -(drop + heightOf(model, lowest, now.up())) / duration;
  flight.velocityChange.z() = rise - after.velocity.z();
  const Vec<double> upRate = cross(now.up(), now.w);
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
