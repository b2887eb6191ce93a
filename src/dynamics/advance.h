// SPDX-License-Identifier: Apache-2.0
// What a simulation does from one look at it to the next.
#pragma once

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

}  // namespace ifa
