// SPDX-License-Identifier: Apache-2.0
// What a simulation does from one look at it to the next.
#pragma once

#include "dynamics/kernel_state.h"
#include "model/contact_step.h"

namespace ifa {

/// What one piece of motion was.
enum class Advance {
  kFlight,   ///< flew one segment; nothing touched
  kTouch,    ///< flew to a touch
  kImpact,   ///< an impact: no time passed
  kContact,  ///< a step in contact
  kLift,     ///< left the ground: no time passed
  kRest      ///< at rest
};

/// One piece of motion of one simulation. Lives while it is told.
struct Piece {
  Advance did;
  const KernelState<double>& before;  ///< of kImpact and kContact: the state before
  const KernelState<double>& state;   ///< where it ended
  const Vec<double>& impulse;         ///< of kImpact and kContact: sum over all points, N s
  bool touching;                      ///< likewise: a vertex is at the ground and does not part

  [[nodiscard]] ContactStep contactStep() const;
};

}  // namespace ifa
