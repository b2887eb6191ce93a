// SPDX-License-Identifier: Apache-2.0
// Audible contact events of a motion (IFA section 4, docs/method.md 2).
#pragma once

#include <vector>

#include "model/rigid_state.h"

namespace ifa {

/// One contact event as a listener hears it.
struct ContactEvent {
  double start = 0;      ///< s, time of the first audible impulse
  double end = 0;        ///< s, time of the last audible impulse; the true end, unfiltered
  double amplitude = 0;  ///< two-norm of the audible excess impulses over 1 ms bins, N s
  double centroid = 0;   ///< eq. 8, s after the start
  bool terminal = false;
  RigidState before;  ///< pre-contact state, at `start`
  RigidState after;   ///< post-contact state, at `end`
  /// The body still touches at `end`: what follows is silent contact, not (yet) flight.
  bool touchingAfter = false;

  /// Duration after the filter: 0 when shorter than the merge gap.
  [[nodiscard]] double filteredDuration(double mergeGap) const {
    return end - start < mergeGap ? 0 : end - start;
  }
};

}  // namespace ifa
