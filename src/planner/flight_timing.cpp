// SPDX-License-Identifier: Apache-2.0
#include "planner/flight_timing.h"

#include <Eigen/LU>
#include <cmath>

#include "base/portable_math.h"
#include "dynamics/energy.h"
#include "dynamics/flight.h"

namespace ifa {

namespace {

using Eigen::Vector3d;

/// Orientation and spin after a torque-free turn.
struct TurnedUp {
  Spin<double> spin;
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
  return {spin, Rotation<double>(spin.q), spin.w};
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
  double least = heightOf(model, 0, up);
  for (std::size_t i = 1; i < model.x.size(); ++i) {
    const double height = heightOf(model, i, up);
    if (height >= least) continue;
    lowest = i;
    least = height;
  }
  return lowest;
}

Vec<double> vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

namespace {

/// One problem of timing, and its steps.
class Timing {
 public:
  Timing(const BodyModel& model, const RigidState& after, const PlausibleRegion& region,
         double duration, const std::optional<Eigen::Vector2d>& level = {})
      : model_(model),
        after_(after),
        region_(region),
        duration_(duration),
        level_(level),
        start_(kernelState(after, 0)),
        rotation_(start_.q),
        drop_(after.position.z() - 0.5 * kGravity * duration * duration) {}

  /// Gives the wish the horizontal velocity that is asked for.
  void steer(Coordinates& wish) const {
    if (!level_) return;
    Vector3d linear, angular;
    region_.change(wish, linear, angular);
    linear.head<2>() = *level_ - after_.velocity.head<2>();
    wish = region_.coordinates(linear, angular);
  }

  /// A Gauss-Newton step of least norm towards a touch in time; false when it is there already.
  bool approach(Coordinates& wish) const {
    Vector3d linear, angular;
    region_.change(wish, linear, angular);
    const Vector3d spin = after_.angularVelocity + angular;
    const TurnedUp now = turned(spin);
    const std::size_t lowest = lowestVertex(model_, now.up());
    const double height = heightOf(model_, lowest, now.up());
    const double miss = drop_ + (after_.velocity.z() + linear.z()) * duration_ + height;
    if (std::abs(miss) < 1e-9) return false;
    const Coordinates slope = timingSlope(spin, now, lowest);
    wish -= slope * (miss / slope.squaredNorm());
    return true;
  }

  /// Closes the time exactly by the vertical velocity.
  [[nodiscard]] std::optional<TimedFlight> close(const Coordinates& wish) const {
    TimedFlight flight;
    region_.change(wish, flight.velocityChange, flight.angularVelocityChange);
    const TurnedUp now = turned(after_.angularVelocity + flight.angularVelocityChange);
    const std::size_t lowest = lowestVertex(model_, now.up());
    const double rise = -(drop_ + heightOf(model_, lowest, now.up())) / duration_;
    flight.velocityChange.z() = rise - after_.velocity.z();
    if (level_) flight.velocityChange.head<2>() = *level_ - after_.velocity.head<2>();
    const Vec<double> upRate = cross(now.up(), now.w);
    if (rise - kGravity * duration_ + heightOf(model_, lowest, upRate) >= 0) return std::nullopt;
    flight.bend = region_.bend(flight.velocityChange, flight.angularVelocityChange);
    flight.departure = after_;
    flight.departure.velocity += flight.velocityChange;
    flight.departure.angularVelocity += flight.angularVelocityChange;
    flight.energy = totalEnergy(model_, flight.departure);
    if (!std::isfinite(flight.bend)) return std::nullopt;
    return flight;
  }

  /// Flight with the spin at `wish`, as far as it turns the body.
  [[nodiscard]] AimingFlight aiming(const Coordinates& wish) const {
    Vector3d linear, angular;
    region_.change(wish, linear, angular);
    const Vector3d spin = after_.angularVelocity + angular;
    const Spin<double> end =
        turn(model_, start_.q, rotation_.transposed(vec(spin)), duration_).spin;
    AimingFlight flight;
    KernelState<double> state = start_;
    state.q = end.q;
    state.w = end.w;
    flight.arrival = rigidState(state);
    // Small enough for first order, large enough for rounding.
    constexpr double kStep = 1e-4;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d nudged = spin + kStep * region_.angularAxes().col(axis);
      const Vec<double> up = turned(nudged).up();
      flight.tilting.col(axis) =
          tiltTo(flight.arrival.orientation, Vector3d(up.x, up.y, up.z)).head<2>() / kStep;
    }
    return flight;
  }

  /// Moves the flight's coordinates so that, to first order, `excess` of energy goes.
  [[nodiscard]] Coordinates cooled(const TimedFlight& flight, double excess) const {
    const RigidState& state = flight.departure;
    const Vec<double> momentum =
        angularMomentum(model_, rotation_, rotation_.transposed(vec(state.angularVelocity)));
    Coordinates slope;
    slope.head<3>() = model_.mass * region_.linearAxes().transpose() * state.velocity;
    slope.tail<3>() =
        region_.angularAxes().transpose() * Vector3d(momentum.x, momentum.y, momentum.z);
    const TurnedUp now = turned(state.angularVelocity);
    const Coordinates timing =
        timingSlope(state.angularVelocity, now, lowestVertex(model_, now.up()));
    slope -= timing * (timing.dot(slope) / timing.squaredNorm());
    return region_.coordinates(flight.velocityChange, flight.angularVelocityChange) -
           slope * (excess / slope.squaredNorm());
  }

 private:
  Coordinates timingSlope(const Vector3d& spin, const TurnedUp& now, std::size_t lowest) const {
    const Vec<double> r =
        now.rotation * Vec<double>{model_.x[lowest], model_.y[lowest], model_.z[lowest]};
    const Vec<double> lever = aimed(vec(spin) * duration_, {r.y * duration_, -r.x * duration_, 0});
    Coordinates slope;
    slope.head<3>() = duration_ * region_.linearAxes().row(2).transpose();
    slope.tail<3>() = region_.angularAxes().transpose() * Vector3d(lever.x, lever.y, lever.z);
    return slope;
  }
  [[nodiscard]] TurnedUp turned(const Vector3d& spin) const {
    return turn(model_, start_.q, rotation_.transposed(vec(spin)), duration_);
  }

  const BodyModel& model_;
  const RigidState& after_;
  const PlausibleRegion& region_;
  double duration_;
  std::optional<Eigen::Vector2d> level_;  ///< horizontal velocity, m/s
  KernelState<double> start_;
  Rotation<double> rotation_;
  double drop_;  ///< height of the centre of mass by then, had it no vertical velocity
};

/// Whether so long a flight takes more energy than there is, however the body turns: the centre of
/// mass does not end under the ground.
bool outlasts(const BodyModel& model, double height, double duration, double mostEnergy) {
  const double rise = 0.5 * kGravity * duration - height / duration;
  return rise > 0 && model.mass * (0.5 * rise * rise + kGravity * height) > mostEnergy;
}

}  // namespace

std::optional<TimedFlight> timeFlight(const BodyModel& model, const RigidState& after,
                                      const PlausibleRegion& region, Coordinates wish,
                                      double duration, double mostEnergy,
                                      const std::optional<Eigen::Vector2d>& level) {
  constexpr int kCoolings = 3;
  if (outlasts(model, after.position.z(), duration, mostEnergy)) return std::nullopt;
  const Timing timing(model, after, region, duration, level);
  timing.steer(wish);
  std::optional<TimedFlight> flight;
  for (int cooling = 0; cooling <= kCoolings; ++cooling) {
    for (int step = 0; step < 2 && timing.approach(wish); ++step) {
    }
    flight = timing.close(wish);
    if (!flight || flight->energy <= mostEnergy) break;
    // A little more than asked for: timing it again gives some back.
    wish = timing.cooled(*flight, 1.1 * (flight->energy - mostEnergy));
  }
  return flight;
}

AimingFlight aimingFlight(const BodyModel& model, const RigidState& after,
                          const PlausibleRegion& region, double duration) {
  return Timing(model, after, region, duration).aiming(Coordinates::Zero());
}

Vector3d tiltTo(const Eigen::Quaterniond& orientation, const Vector3d& up) {
  const Vector3d now = orientation.conjugate() * Vector3d::UnitZ();
  const Vector3d axis = now.cross(up);
  const double sine = axis.norm(), cosine = now.dot(up);
  if (sine < 1e-12) return Vector3d::Zero();
  const double angle = cosine >= 0 ? portableAngle(sine, cosine)
                                   : 3.14159265358979324 - portableAngle(sine, -cosine);
  // What the body sees turn one way turns it the other way in the world.
  return orientation * (axis * (-angle / sine));
}

std::optional<TimedFlight> aimFlight(const BodyModel& model, const RigidState& after,
                                     const PlausibleRegion& region, double duration,
                                     const Vector3d& up) {
  constexpr int kSteps = 8;
  constexpr double kNear = 1e-3, kNearEnough = 0.01;  // rad
  const Timing timing(model, after, region, duration);
  Coordinates wish = Coordinates::Zero();
  double missed = 0;
  for (int step = 0;; ++step) {
    const AimingFlight flight = timing.aiming(wish);
    const Vector3d tilt = tiltTo(flight.arrival.orientation, up);
    missed = tilt.norm();
    if (missed < kNear || step == kSteps) break;
    const Eigen::Matrix2d normal = flight.tilting * flight.tilting.transpose();
    wish.tail<3>() += flight.tilting.transpose() * normal.inverse() * tilt.head<2>();
    if (!(wish.squaredNorm() < 100)) return std::nullopt;
  }
  if (missed > kNearEnough) return std::nullopt;
  return timing.close(wish);
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
