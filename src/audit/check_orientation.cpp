// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "audit/checks.h"
#include "audit/orientation_errors.h"

namespace ifa {

using namespace audit_detail;

namespace {

/// The body at the start of the contact, or at the motion's end.
const MotionSample& sampleOf(const Motion& motion, const MotionOrientation& wish) {
  if (wish.contact < 0) return motion.trajectory.back();
  const double time = motion.contacts[static_cast<std::size_t>(wish.contact)].time;
  const auto at =
      std::find_if(motion.trajectory.begin(), motion.trajectory.end(),
                   [&](const MotionSample& sample) { return sample.time >= time - kSameTime; });
  return at == motion.trajectory.end() ? motion.trajectory.back() : *at;
}

double errorOf(const MotionOrientation& wish, const MotionSample& sample) {
  const Eigen::Vector3d shown = sample.orientation * wish.body;
  return std::atan2(shown.cross(wish.world).norm(), shown.dot(wish.world));
}

}  // namespace

std::vector<double> orientationErrors(const Motion& motion) {
  std::vector<double> errors;
  for (const MotionOrientation& wish : motion.orientations)
    errors.push_back(errorOf(wish, sampleOf(motion, wish)));
  return errors;
}

void audit_detail::checkOrientations(const Evidence& all, Checks& checks) {
  if (all.motion.orientations.empty()) return;
  Worst worst;
  for (const MotionOrientation& wish : all.motion.orientations) {
    const MotionSample& sample = sampleOf(all.motion, wish);
    worst.see(errorOf(wish, sample), sample.time);
  }
  checks.push_back(worst.check("orientation as asked", "rad", kOrientationMet));
}

}  // namespace ifa
