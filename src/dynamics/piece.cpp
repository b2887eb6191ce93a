// SPDX-License-Identifier: Apache-2.0
#include "dynamics/piece.h"

namespace ifa {

ContactStep Piece::contactStep() const {
  ContactStep step;
  step.time = before.time;
  step.duration = state.time - before.time;
  step.impulse = {impulse.x, impulse.y, impulse.z};
  step.before = rigidState(before);
  step.after = rigidState(state);
  step.touching = touching;
  return step;
}

}  // namespace ifa
