// SPDX-License-Identifier: Apache-2.0
// The affinity factors of IFA section 5.4 and the scores made of them, in one place. All are kept
// as natural logarithms: products become sums, and no transcendental function is needed while
// planning.
#pragma once

#include <Eigen/Core>

#include "ifa/motion.h"
#include "model/rigid_state.h"

namespace ifa {

/// Parameters of equations 2 to 8, as printed.
struct AffinityParameters {
  double maxRelativeLinear = 0.4;           ///< phi_L
  double maxRelativeAngular = 0.2;          ///< phi_A
  double tanLinear = 0.36397023426620234;   ///< tan theta_L, theta_L = 20 degrees
  double tanAngular = 0.17632698070846498;  ///< tan theta_A, theta_A = 10 degrees
  double orientation = 0.85;                ///< c_q, eq. 4
  double orientationTime = 0.2;             ///< T_0, s, eq. 4
  double timeWarp = 100;                    ///< c_t, eq. 5
  double amplitude = 2.78;                  ///< c_a, eq. 6
  double duration = 7000;                   ///< c_Delta, s^-2, eq. 7 and 8
  double orientationWish = 140;             ///< c_o, section 6: half at 4 degrees
  double positionWish = 7000;               ///< c_p, section 6, m^-2: half at 1 cm
  /// Decision: a contact that changes the velocity by less is taken to change it by this much, or
  /// the plausible region would vanish. m/s; for the spin, this over the body's radius.
  double smallestChange = 0.05;
};

/// Eq. 2: how far the velocities after a contact may be changed and still look plausible.
class PlausibleRegion {
 public:
  /// @param linear, angular  changes of velocity by the contact, world frame, m/s and rad/s
  /// @param radius           of the body, m
  PlausibleRegion(const Eigen::Vector3d& linear, const Eigen::Vector3d& angular, double radius,
                  const AffinityParameters& parameters = {});

  /// Change of (linear, angular) velocity at coordinates `y`, in which the region is the unit ball.
  /// The coordinates: along and twice across the linear change, then the same for the angular one.
  void change(const Eigen::Matrix<double, 6, 1>& y, Eigen::Vector3d& linear,
              Eigen::Vector3d& angular) const;
  /// The inverse: C v_eval of eq. 3.
  [[nodiscard]] Eigen::Matrix<double, 6, 1> coordinates(const Eigen::Vector3d& linear,
                                                        const Eigen::Vector3d& angular) const;
  /// Bend: the length of C v_eval; 1 at the region's edge.
  [[nodiscard]] double bend(const Eigen::Vector3d& linear, const Eigen::Vector3d& angular) const {
    return coordinates(linear, angular).norm();
  }
  /// Columns: change of linear (or angular) velocity by each of its three unit coordinates.
  [[nodiscard]] const Eigen::Matrix3d& linearAxes() const { return linearAxes_; }
  [[nodiscard]] const Eigen::Matrix3d& angularAxes() const { return angularAxes_; }

 private:
  Eigen::Matrix3d linearAxes_, angularAxes_;  ///< orthogonal columns, scaled by the half-axes
};

/// Eq. 3.
[[nodiscard]] inline double logVelocity(double bend) { return -bend * bend; }

/// Eq. 4. @param angle  between the orientations, rad. @param time  of the flight, s
[[nodiscard]] double logOrientation(double angle, double time, const AffinityParameters& = {});

/// f_o of section 6. @param angle  between where a direction of the body points and where it
/// should, rad
[[nodiscard]] inline double logOrientationWish(double angle, const AffinityParameters& set = {}) {
  return -set.orientationWish * angle * angle;
}

/// f_p of section 6. @param distance  between where a contact begins and where it should, m
[[nodiscard]] inline double logPositionWish(double distance, const AffinityParameters& set = {}) {
  return -set.positionWish * distance * distance;
}

/// Eq. 5. @param target, blended  times of the flight, s, > 0
[[nodiscard]] double logTimeWarp(double target, double blended, const AffinityParameters& = {});

/// One event as equations 6 to 8 see it: filtered duration, relative amplitude, centroid.
struct HeardEvent {
  double amplitude = 1, duration = 0, centroid = 0;
};
/// Eq. 6.
[[nodiscard]] double logAmplitude(const HeardEvent& target, const HeardEvent& event,
                                  const AffinityParameters& = {});
/// Eq. 7. Decision: 1 without computing only when both are discrete; a rattle against a click pays.
[[nodiscard]] double logDuration(const HeardEvent& target, const HeardEvent& event,
                                 const AffinityParameters& = {});
/// Eq. 8, likewise.
[[nodiscard]] double logCentroid(const HeardEvent& target, const HeardEvent& event,
                                 const AffinityParameters& = {});

/// Eq. 10: whether a state that leaves a contact has no more energy than came in, but for `gain`.
[[nodiscard]] inline bool energyAllows(double before, double after, double gain) {
  return after <= before * (1 + gain);
}

/// Sums of logarithms over the contacts of a path.
struct LogScore {
  double sound = 0;     ///< f_a f_l f_c
  double motion = 0;    ///< f_v f_q f_t
  double velocity = 0;  ///< f_v alone

  [[nodiscard]] double total() const { return sound + motion; }
  /// Eq. 12 and 13, and the geometric mean of f_v, for n contacts.
  [[nodiscard]] double score(int n) const;
  [[nodiscard]] double scoreWithoutSound(int n) const;
  [[nodiscard]] double meanVelocity(int n) const;
};

}  // namespace ifa
