// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "audit/checks.h"

namespace ifa::audit_detail {
namespace {

/// IFA section 6: c_o sets the half-width of f_o to 4 degrees.
constexpr double kAsAsked = 4 * 3.14159265358979323846 / 180;

/// The body at the start of the contact, or at the motion's end.
const MotionSample& sampleOf(const Motion& motion, const MotionOrientation& wish) {
  if (wish.contact < 0) return motion.trajectory.back();
  const double time = motion.contacts[static_cast<std::size_t>(wish.contact)].time;
  const auto at =
      std::find_if(motion.trajectory.begin(), motion.trajectory.end(),
                   [&](const MotionSample& sample) { return sample.time >= time - kSameTime; });
  return at == motion.trajectory.end() ? motion.trajectory.back() : *at;
}

}  // namespace

void checkOrientations(const Evidence& all, Checks& checks) {
  if (all.motion.orientations.empty()) return;
  Worst worst;
  for (const MotionOrientation& wish : all.motion.orientations) {
    const MotionSample& sample = sampleOf(all.motion, wish);
    const Eigen::Vector3d shown = sample.orientation * wish.body;
    worst.see(std::atan2(shown.cross(wish.world).norm(), shown.dot(wish.world)), sample.time);
  }
  checks.push_back(worst.check("orientation as asked", "rad", kAsAsked));
}

}  // namespace ifa::audit_detail
