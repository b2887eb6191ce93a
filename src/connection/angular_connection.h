// SPDX-License-Identifier: Apache-2.0
// Angular connection: the spin that turns a body from one orientation to another in a given time,
// by damped Newton shooting. IFA 5.3.2.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dynamics/body_model.h"

namespace ifa {

/// Equation that a Newton step solves.
enum class ShootingStep {
  /// All three components of the error log(q(T) q_1^-1) at once: quadratic convergence.
  kVector,
  /// As printed: the one number f = |log(q(T) q_1^-1)|^2, by the change of momentum that is smallest
  /// in the metric of I^-1 (W = I). f has a double root, so that the error halves at each step.
  kSquaredAngle,
};

struct ShootingSettings {
  ShootingStep step = ShootingStep::kVector;
  double tolerance = 1e-10;          ///< rad, angle missed that counts as none
  double largestTurn = 0.174532925;  ///< rad, |change of spin| T of a step at most; 10 degrees, printed
  int mostSteps = 60;                ///< Decision: then it is taken not to converge; of each try
};

/// How a shooting went, and the spin found.
struct AngularConnection {
  bool converged = false;
  int steps = 0;        ///< Newton steps made
  double missed = 0;    ///< angle left at the end, rad
  Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero();  ///< at the start, world frame, rad/s
  Eigen::Vector3d atEnd = Eigen::Vector3d::Zero();            ///< the same at the end, rad/s
};

/// The angular velocity that takes `from` to `to` (either sign) in `duration` seconds of
/// torque-free rotation; of the many that do, one near `guess`. Thread safe.
/// @param from, to  world from principal frame
/// @param duration  s, > 0
/// @param guess     world frame, rad/s
[[nodiscard]] AngularConnection angularConnection(const BodyModel& model,
                                                  const Eigen::Quaterniond& from,
                                                  const Eigen::Quaterniond& to, double duration,
                                                  const Eigen::Vector3d& guess,
                                                  const ShootingSettings& settings = {});

/// Spin of the mean of two angular momenta, in the pose of the first: where the printed method
/// starts.
/// @param from, to          orientations
/// @param spinFrom, spinTo  angular velocities, world frame, rad/s
[[nodiscard]] Eigen::Vector3d meanMomentumSpin(const BodyModel& model,
                                               const Eigen::Quaterniond& from,
                                               const Eigen::Vector3d& spinFrom,
                                               const Eigen::Quaterniond& to,
                                               const Eigen::Vector3d& spinTo);

}  // namespace ifa
