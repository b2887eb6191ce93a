// SPDX-License-Identifier: Apache-2.0
// Where on the floor a motion is laid. The floor is level and the same everywhere, so a motion that
// is turned about the vertical and shifted along the floor stays valid.
#pragma once

#include <Eigen/Core>

#include "ifa/motion.h"
#include "model/pose_track.h"

namespace ifa {

struct FloorPlace {
  double turn = 0;                                  ///< rad about the vertical, first
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< m, then

  [[nodiscard]] Pose apply(const Pose& pose) const;
  /// The whole motion there: trajectory, contacts, wishes.
  [[nodiscard]] Motion apply(Motion motion) const;
};

}  // namespace ifa
