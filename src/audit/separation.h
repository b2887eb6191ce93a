// SPDX-License-Identifier: Apache-2.0
// Whether bodies that share a floor ever meet, by arithmetic of its own (docs/audit.md).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "body/body.h"
#include "ifa/motion.h"

namespace ifa {

/// A motion as it is laid on the floor: turned about the vertical (rad), then shifted (m). Its
/// first contact lies at `motion->sound.firstContact` of the common time.
struct LaidMotion {
  const Motion* motion = nullptr;
  const Body* body = nullptr;
  double turn = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
};

/// Which two bodies come nearest, and when.
struct Separation {
  double least = 0;  ///< m, proven: a plane stands between them with so much room; <= 0: they meet
  std::size_t one = 0, other = 0;  ///< indices of the bodies
  double time = 0;                 ///< s of the common time
  bool known = false;              ///< false where no two bodies are there at the same time
};

/// Looks at all pairs of hulls `rate` times a second, from where both motions have begun to the end
/// of the last one (a motion that has ended rests). Shares nothing with the placing of bodies:
/// poses are interpolated along straight lines between samples, and what is looked for is the
/// direction in which two bodies are furthest apart, which proves a distance whatever way it was
/// found.
[[nodiscard]] Separation leastSeparation(const std::vector<LaidMotion>& motions,
                                         double rate = 1000);

}  // namespace ifa
