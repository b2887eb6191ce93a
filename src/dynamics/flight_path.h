// SPDX-License-Identifier: Apache-2.0
// The motion of a body that nothing touches: a parabola and a torque-free rotation.
#ifndef IFA_DYNAMICS_FLIGHT_PATH_H
#define IFA_DYNAMICS_FLIGHT_PATH_H

#include "dynamics/free_rotation.h"
#include "dynamics/lane_state.h"

namespace ifa {

/// Whether the rotation in flight has a closed form, good for any time.
inline bool closedForm(const BodyModel& body) { return body.isotropic || body.symmetryAxis >= 0; }

/// Heights of body points and their rates in one state.
template <class R>
struct PointHeights {
  explicit PointHeights(const KernelState<R>& s) : z(s.position.z), vz(s.velocity.z) {
    up = Rotation<R>(s.q).rows[2];
    upRate = cross(up, s.w);
  }
  [[nodiscard]] R height(const Vec<R>& p) const { return z + dot(p, up); }
  [[nodiscard]] R rate(const Vec<R>& p) const { return vz + dot(p, upRate); }
  R z, vz;
  Vec<R> up, upRate;
};

/// A state that was looked at, `t` seconds from the start.
template <class R>
struct PathPoint {
  R t;
  KernelState<R> state;
};

/// The model must outlive it.
template <class R>
class FlightPath {
 public:
  FlightPath(const BodyModel& body, const KernelState<R>& start)
      : body_(body), start_(start), rotation_(body, {start.q, start.w}) {
    spin2_ = dot(start.w, start.w);
  }

  [[nodiscard]] const KernelState<R>& start() const { return start_; }

  /// State `t` seconds after the start.
  [[nodiscard]] KernelState<R> at(R t) const {
    const Spin<R> spin = rotation_.at(t);
    KernelState<R> s = start_;
    s.time = s.time + t;
    s.position = s.position + s.velocity * t;
    s.position.z = s.position.z - R(0.5 * kGravity) * t * t;
    s.velocity.z = s.velocity.z - R(kGravity) * t;
    s.q = spin.q;
    s.w = spin.w;
    return s;
  }

  /// Seconds for which the rotation is exact enough and heights are as good as cubics, or in which
  /// the body is too high to touch; `longest` at most.
  [[nodiscard]] R length(R longest) const {
    const KernelSettings& settings = body_.settings;
    const R angle(body_.isotropic ? settings.isotropicAngle : settings.segmentAngle);
    R length = angle / laneMax(laneSqrt(spin2_), R(1.0));
    if (closedForm(body_)) length = laneMax(length, timeAbove());
    return laneMin(longest, length);
  }

  /// A parabola is lowest at its ends; so is the sum of one and of what a vertex adds, but for the
  /// bend of its circle: |up''| <= 2 w^2 within a segment.
  [[nodiscard]] R bend(R length) const {
    return R(0.25) * length * length * R(body_.radius) * spin2_;
  }

  /// Newton steps on the exact motion from `t`, where the point `p` of the body is near the ground,
  /// to where it is at it, within `length`. Leaves in `seen` the last state looked at.
  [[nodiscard]] R refined(R t, const Vec<R>& p, R length, PathPoint<R>& seen) const {
    LaneMask<R> live(true);
    for (int i = 0; i < 3; ++i) {
      seen = {t, at(t)};  // the same again where `t` stays
      const PointHeights<R> heights(seen.state);
      const R height = heights.height(p), rate = heights.rate(p), off = laneAbs(height);
      live = live & !((rate > R(-1e-4)) | (off < R(kOnGround)));
      if (!anyLane(live)) break;
      const R next = t - height / rate;
      live = live & (next > R(0.0)) & (next < length);
      if (!anyLane(live)) break;
      setWhere(live, t, next);
    }
    return t;
  }

 private:
  /// A touch is found when the vertex is as near to the ground as this, m: the planner asks for its
  /// time to 1e-7 s.
  static constexpr double kOnGround = 1e-11;

  /// Seconds in which the body, whatever its turn, is too high to touch; 0 when it is not.
  [[nodiscard]] R timeAbove() const {
    const R zero(0.0), g(kGravity), rise = start_.velocity.z;
    const R over = start_.position.z - R(1.0001 * body_.radius);
    const LaneMask<R> above = over > zero;
    if (!anyLane(above)) return zero;
    const R fall = laneSqrt(rise * rise + R(2 * kGravity) * laneMax(over, zero));
    return select(above, (rise + fall) / g, zero);
  }

  const BodyModel& body_;
  KernelState<R> start_;
  FreeRotation<R> rotation_;
  R spin2_;
};

}  // namespace ifa

#endif
