// SPDX-License-Identifier: Apache-2.0
// Motions of which only where the body is matters.
#pragma once

#include <cmath>
#include <functional>

#include "ifa/motion.h"

namespace ifa::test {

/// A body that is at `where(t)` from `begin` to `end`, 240 samples a second, and does not turn.
/// @param first  s of the sound at time 0
inline Motion madeMotion(double first, double begin, double end,
                         const std::function<Eigen::Vector3d(double)>& where) {
  Motion motion;
  motion.sound.firstContact = first;
  const int count = static_cast<int>(std::ceil((end - begin) * 240));
  for (int i = 0; i <= count; ++i) {
    MotionSample sample;
    sample.time = begin + (end - begin) * i / count;
    sample.position = where(sample.time);
    sample.velocity = (where(sample.time + 1e-5) - where(sample.time - 1e-5)) / 2e-5;
    motion.trajectory.push_back(sample);
  }
  return motion;
}

/// At rest.
inline Motion stillMotion(const Eigen::Vector3d& place) {
  return madeMotion(0, 0, 0.5, [=](double) { return place; });
}

}  // namespace ifa::test
