// SPDX-License-Identifier: Apache-2.0
// Ballistic flight, exact: parabola, torque-free rotation, and the first vertex that touches the
// ground.
#pragma once

#include "dynamics/body_model.h"
#include "dynamics/free_rotation.h"
#include "dynamics/kernel_state.h"

namespace ifa {

/// Height of one vertex over a segment as a cubic in s = 0..1 (Hermite), and its first way down
/// through 0. Over a turn of a the cubic is within r a^4 / 384 of the truth.
template <class R>
struct HeightCubic {
  R h0, c1, c2, c3;

  HeightCubic(R startHeight, R startRate, R endHeight, R endRate, R length) {
    h0 = startHeight;
    c1 = startRate * length;
    const R end = endRate * length, rise = endHeight - startHeight;
    c2 = R(3.0) * rise - R(2.0) * c1 - end;
    c3 = c1 + end - R(2.0) * rise;
  }
  [[nodiscard]] R at(R s) const { return ((c3 * s + c2) * s + c1) * s + h0; }
  [[nodiscard]] R slope(R s) const { return (R(3.0) * c3 * s + R(2.0) * c2) * s + c1; }

  /// First s in [0, 1] at which the height falls through zero, 2 if there is none. A vertex that
  /// starts at or just under zero and rises must fall again first.
  [[nodiscard]] R firstTouch() const;
};

template <>
inline double HeightCubic<double>::firstTouch() const {
  const double discriminant = c2 * c2 - 3 * c1 * c3;
  const double root = discriminant > 0 ? std::sqrt(discriminant) : 0;
  double low = 0;
  if (c1 > 0) {
    const double down = root - c2;  // highest point: c1 / (root - c2)
    if (discriminant <= 0 || down <= c1) return 2;
    low = c1 / down;
  }
  if (at(low) <= 0) return low;
  double high = 1;
  if (at(1) >= 0) {
    if (discriminant <= 0) return 2;
    high = c2 > 0 ? -c1 / (c2 + root) : (c3 > 0 ? (root - c2) / (3 * c3) : 2);
    if (!(high > low && high < 1) || at(high) >= 0) return 2;
  }
  double s = 0.5 * (low + high);
  for (int i = 0; i < 30; ++i) {
    const double height = at(s);
    (height > 0 ? low : high) = s;
    const double rate = slope(s);
    double next = rate < 0 ? s - height / rate : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::fabs(next - s) < 1e-7) return next;
    s = next;
  }
  return s;
}

/// Whether the rotation in flight has a closed form, good for any time.
inline bool closedForm(const BodyModel& body) { return body.isotropic || body.symmetryAxis >= 0; }

/// One segment of a flight, with its first touch. Not to be shared between threads: it remembers
/// the state that was asked for last.
class FlightSegment {
 public:
  FlightSegment(const BodyModel& body, const KernelState<double>& start, double longest)
      : body_(body), start_(start), rotation_(body, {start.q, start.w}) {
    spin2_ = dot(start.w, start.w);
    const double angle = body.isotropic ? body.settings.isotropicAngle : body.settings.segmentAngle;
    length_ = angle / laneMax(laneSqrt(spin2_), 1.0);
    if (closedForm(body)) length_ = laneMax(length_, timeAbove());
    if (longest < length_) length_ = longest;
    lastTime_ = length_;
    last_ = computed(length_);
  }

  [[nodiscard]] double length() const { return length_; }

  /// State `t` seconds after the segment's start.
  [[nodiscard]] KernelState<double> at(double t) const {
    return t == lastTime_ ? last_ : computed(t);
  }

  /// Seconds from the start to the first touch; larger than length() when nothing touches.
  [[nodiscard]] double firstTouch() const;

 private:
  /// Heights of body points and their rates in one state.
  struct Heights {
    explicit Heights(const KernelState<double>& s) : z(s.position.z), vz(s.velocity.z) {
      up = Rotation<double>(s.q).rows[2];
      upRate = cross(up, s.w);
    }
    [[nodiscard]] double height(const Vec<double>& p) const { return z + dot(p, up); }
    [[nodiscard]] double rate(const Vec<double>& p) const { return vz + dot(p, upRate); }
    double z, vz;
    Vec<double> up, upRate;
  };

  /// A vertex that comes near the ground, and its heights at the segment's ends.
  struct Candidate {
    std::size_t vertex;
    double h0, h1;
  };
  static constexpr std::size_t kMostCandidates = 128;

  [[nodiscard]] KernelState<double> computed(double t) const;
  [[nodiscard]] double timeAbove() const;
  [[nodiscard]] double refined(double t, std::size_t vertex) const;
  std::size_t findLow(const Heights& a, const Heights& b, double dip, std::size_t& next,
                      Candidate* found) const;
  [[nodiscard]] Vec<double> place(std::size_t i) const {
    return {body_.rows.x[i], body_.rows.y[i], body_.rows.z[i]};
  }

  const BodyModel& body_;
  KernelState<double> start_;
  FreeRotation<double> rotation_;
  double spin2_, length_;
  mutable double lastTime_;
  mutable KernelState<double> last_;
};

}  // namespace ifa
