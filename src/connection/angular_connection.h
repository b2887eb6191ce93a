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
  /// As printed: the one number f = |log(q(T) q_1^-1)|^2, by the change of momentum that is
  /// smallest
  /// in the metric of I^-1 (W = I). f has a double root, so that the error halves at each step.
  kSquaredAngle,
};

struct ShootingSettings {
  ShootingStep step = ShootingStep::kVector;
  double tolerance = 1e-10;  ///< rad, angle missed that counts as none
  /// rad, |change of spin| T of a step at most; 10 degrees as printed. Wider steps converge more
  /// often (docs/connections.md).
  double largestTurn = 0.52359877559829887;
  int mostSteps = 60;  ///< Decision: then it is taken not to converge; of each try
};

/// How a shooting went, and the spin found.
struct AngularConnection {
  bool converged = false;
  int steps = 0;                                              ///< Newton steps made, of all tries
  double missed = 0;                                          ///< angle left at the end, rad
  Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero();  ///< at the start, world frame, rad/s
  Eigen::Vector3d atEnd = Eigen::Vector3d::Zero();            ///< the same at the end, rad/s
};

/// The angular velocity that takes `from` to `to` (either sign) in `duration` seconds of
/// torque-free rotation; of the many that do, one near `guess`. Thread safe.
/// Decision: kVector damps its steps (Levenberg and Marquardt in the metric of I, so that steps are
/// short where the end hardly depends on the spin) and keeps only those that come nearer; where it
/// gets stuck it starts again with the guess turning the body 1 or 2 rad more or less. Where all
/// moments are equal the nearest spin is known in closed form, and no step is needed.
/// Deviation: slopes come from the variational equation, not from forward differences.
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
