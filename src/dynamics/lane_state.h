// SPDX-License-Identifier: Apache-2.0
// State of the kernel over lanes.
#ifndef IFA_DYNAMICS_LANE_STATE_H
#define IFA_DYNAMICS_LANE_STATE_H

#include "dynamics/lane.h"

namespace ifa {

/// Pose and velocities; the angular velocity in the body (principal) frame.
template <class R>
struct KernelState {
  R time{};
  Vec<R> position{};
  Quat<R> q{};
  Vec<R> velocity{};
  Vec<R> w{};
};

template <class R>
KernelState<R> select(const LaneMask<R>& mask, const KernelState<R>& yes,
                      const KernelState<R>& no) {
  return {select(mask, yes.time, no.time), select(mask, yes.position, no.position),
          select(mask, yes.q, no.q), select(mask, yes.velocity, no.velocity),
          select(mask, yes.w, no.w)};
}

}  // namespace ifa

#endif
