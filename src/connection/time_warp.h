// SPDX-License-Identifier: Apache-2.0
// Time warp: a flight shown at another, even pace. IFA 5.3.2, docs/connections.md.
#pragma once

#include "model/rigid_state.h"

namespace ifa {

/// A flight of `flightTime` seconds that is shown in `shownTime` seconds. Shown gravity is
/// g / stretch^2.
struct TimeWarp {
  double flightTime = 0;  ///< T_b, s, > 0
  double shownTime = 0;   ///< T*, s, > 0

  /// T* / T_b, `retiming` of motion.json; 1 where nothing is warped.
  [[nodiscard]] double stretch() const { return shownTime / flightTime; }
  /// T_eval of eq. 5.
  [[nodiscard]] double amount() const {
    const double s = stretch();
    return (s < 1 ? 1 / s : s) - 1;
  }
  /// Time of the flight that is seen `t` seconds after its shown start.
  [[nodiscard]] double flightTimeAt(double t) const { return t * flightTime / shownTime; }
  /// A state of the flight with the velocities it is seen with.
  [[nodiscard]] RigidState shown(RigidState state) const {
    state.velocity /= stretch();
    state.angularVelocity /= stretch();
    return state;
  }
};

}  // namespace ifa
