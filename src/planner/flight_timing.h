// SPDX-License-Identifier: Apache-2.0
// Small changes of velocity after a contact, such that the next touch falls on a given time
// (docs/planner.md).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "affinity/factors.h"
#include "dynamics/body_model.h"
#include "model/rigid_state.h"

namespace ifa {

using Coordinates = Eigen::Matrix<double, 6, 1>;  ///< of a PlausibleRegion

/// A flight that takes exactly the time asked for.
struct TimedFlight {
  Eigen::Vector3d velocityChange, angularVelocityChange;  ///< world frame, m/s and rad/s
  RigidState departure;                                   ///< after the change
  double bend = 0;
  double energy = 0;  ///< of the departure, J
};

/// The change nearest to the coordinates `wish` (in the metric of the plausible region) after which
/// the lowest vertex is on the ground `duration` seconds later and on its way down: two
/// Gauss-Newton steps of least norm over all six coordinates, then closed exactly by the vertical
/// velocity. Where `level` is given, the horizontal velocity is that. Whether something touches
/// earlier is not looked at here. None where so long a flight takes more than `mostEnergy`, J.
[[nodiscard]] std::optional<TimedFlight> timeFlight(
    const BodyModel& model, const RigidState& after, const PlausibleRegion& region,
    Coordinates wish, double duration, double mostEnergy,
    const std::optional<Eigen::Vector2d>& level = {});

/// How a flight whose spin is not changed arrives `duration` seconds later, and what tilts it.
struct AimingFlight {
  RigidState arrival;  ///< orientation and spin; position and velocity are the departure's
  /// Tilt of the arrival about the world's x and y axes by the three angular coordinates of the
  /// plausible region, rad for each: by differences.
  Eigen::Matrix<double, 2, 3> tilting;
};
[[nodiscard]] AimingFlight aimingFlight(const BodyModel& model, const RigidState& after,
                                        const PlausibleRegion& region, double duration);

/// Tilt about horizontal axes that turns a body which sees the vertical (unit, its own axes) where
/// `orientation` has it until it sees it at `up`: rotation vector, world frame, rad. Up to half a
/// turn.
[[nodiscard]] Eigen::Vector3d tiltTo(const Eigen::Quaterniond& orientation,
                                     const Eigen::Vector3d& up);

/// The change nearest to none of the spin after which the body sees the vertical at `up` (unit,
/// principal frame) `duration` seconds later, closed in time by the vertical velocity. None where
/// the steps do not come within a hundredth of a radian.
[[nodiscard]] std::optional<TimedFlight> aimFlight(const BodyModel& model, const RigidState& after,
                                                   const PlausibleRegion& region, double duration,
                                                   const Eigen::Vector3d& up);

/// State at the first touch of a flight from `departure` within `limit` seconds, and when.
struct Touch {
  double time = 0;
  RigidState state;
};
[[nodiscard]] std::optional<Touch> firstTouch(const BodyModel& model, const RigidState& departure,
                                              double limit);

}  // namespace ifa
