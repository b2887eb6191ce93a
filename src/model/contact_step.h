// SPDX-License-Identifier: Apache-2.0
// What a solver tells about one impact or one step in contact; events are found in a row of these.
#pragma once

#include "model/rigid_state.h"

namespace ifa {

/// One impact (`duration` 0) or one small step in contact.
struct ContactStep {
  double time = 0;      ///< s, at its beginning
  double duration = 0;  ///< s
  Eigen::Vector3d impulse =
      Eigen::Vector3d::Zero();  ///< sum over all contact points, world frame, N s
  RigidState before;            ///< at `time`
  RigidState after;             ///< at `time + duration`
  bool touching = false;        ///< still in contact afterwards
};

}  // namespace ifa
