// SPDX-License-Identifier: Apache-2.0
// How long a list of the vertices near the ground is good for.
#ifndef IFA_DYNAMICS_GROUND_COVER_H
#define IFA_DYNAMICS_GROUND_COVER_H

#include "dynamics/body_model.h"
#include "dynamics/lane.h"

namespace ifa {

/// What a list was made for: every vertex within `margin` of the ground then. Eight numbers, one
/// after the other, so that they can be moved together.
template <class R>
struct GroundCover {
  R height{};       ///< of the centre, m
  Vec<R> up{};      ///< the world's z axis, body frame
  R mostKinetic{};  ///< J, for which `reach` is enough; 0: there is no list
  R reach{};        ///< m, how far a step can bring a vertex down
  R margin{};       ///< what is not listed was higher than this, m
  R count{};        ///< length of the list

  /// Every vertex that can be at the ground by the end of a step is listed.
  [[nodiscard]] LaneMask<R> holds(const BodyModel& body, const R& heightNow, const Vec<R>& upNow,
                                  const R& kinetic) const {
    const Vec<R> turned = upNow - up;
    const R left = margin - reach + (heightNow - height), moving = floored(body, kinetic);
    return (moving <= mostKinetic) & (moving * R(kSlower) >= mostKinetic) & (left > R(0.0)) &
           (R(body.radius * body.radius) * dot(turned, turned) < left * left);
  }
  /// Sets it for a new list.
  void renew(const BodyModel& body, const R& heightNow, const Vec<R>& upNow, const R& kinetic) {
    const double step = body.step + kTogether;
    height = heightNow;
    up = upNow;
    mostKinetic = R(kFaster) * floored(body, kinetic);
    const R speed = R(body.speedRoot) * laneSqrt(R(2.0) * mostKinetic) + R(kGravity * step);
    reach = speed * R(step) + R(body.slop);
    margin = R(kFarther) * reach + R(kFartherRadii * body.radius);
  }

 private:
  /// How far beyond what must be seen a new list reaches, in that distance and in radii of the
  /// body, and what kinetic energy it is good for, in that of the moment.
  static constexpr double kFarther = 2, kFartherRadii = 0.005, kFaster = 1.5;
  /// A list made for so many times the kinetic energy is too long to keep; slower bodies than kSlow
  /// (m/s) are not told apart.
  static constexpr double kSlower = 8, kSlow = 0.05;

  static R floored(const BodyModel& body, const R& kinetic) {
    return laneMax(kinetic, R(0.5 * body.mass * kSlow * kSlow));
  }
};

}  // namespace ifa

#endif
