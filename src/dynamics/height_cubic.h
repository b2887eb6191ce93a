// SPDX-License-Identifier: Apache-2.0
// Height of one vertex over a stretch of motion, and where it comes down to the ground.
#ifndef IFA_DYNAMICS_HEIGHT_CUBIC_H
#define IFA_DYNAMICS_HEIGHT_CUBIC_H

#include "dynamics/lane.h"

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
  /// starts at or just under zero and rises must fall again first. Others than `lanes` get
  /// anything.
  [[nodiscard]] R firstTouch(const LaneMask<R>& lanes = LaneMask<R>(true)) const {
    const R zero(0.0), none(2.0);
    const R discriminant = c2 * c2 - R(3.0) * c1 * c3;
    const Turns turns{discriminant > zero, laneSqrt(laneMax(discriminant, zero))};
    const LaneMask<R> rises = c1 > zero;
    R low = zero;
    if (anyLane(rises)) setWhere(rises, low, highest(turns));
    const R lowHeight = at(low);
    LaneMask<R> open = lanes & (low < none) & (lowHeight > zero);
    if (!anyLane(open)) return low;
    R touch = low, high(1.0), highHeight = h0 + c1 + c2 + c3;
    const LaneMask<R> returns = open & (highHeight >= zero);
    if (anyLane(returns)) {
      const R bottom = lowest(turns, low);
      setWhere(returns, high, bottom);
      setWhere(returns, highHeight, at(bottom));
      const LaneMask<R> misses = returns & (bottom >= none);
      setWhere(misses, touch, none);
      open = open & !misses;
      if (!anyLane(open)) return touch;
    }
    setWhere(open, touch, guess(low, lowHeight, select(rises, zero, c1), high, highHeight));
    return between(low, high, open, touch);
  }

 private:
  /// Whether the slope has zeros, and the root of its discriminant.
  struct Turns {
    LaneMask<R> real;
    R root;
  };

  /// Where a height that rises first is highest, 2 where that is not within the segment.
  [[nodiscard]] R highest(const Turns& turns) const {
    const R down = turns.root - c2;
    return select(turns.real & (down > c1), c1 / down, R(2.0));
  }

  /// Where it is lowest beyond `low`, 2 where that is not within the segment or not under zero.
  [[nodiscard]] R lowest(const Turns& turns, R low) const {
    const R zero(0.0), none(2.0);
    const LaneMask<R> bendsUp = c2 > zero, turnsUp = c3 > zero;
    R s = none;
    if (anyLane(bendsUp)) setWhere(bendsUp, s, (zero - c1) / (c2 + turns.root));
    const LaneMask<R> other = turnsUp & !bendsUp;
    if (anyLane(other)) setWhere(other, s, (turns.root - c2) / (R(3.0) * c3));
    const R height = at(s);
    return select(turns.real & (s > low) & (s < R(1.0)) & (height < zero), s, none);
  }

  /// Where the parabola that has the height and the slope of `low` and the height of `high` comes
  /// down through 0, on the way from over it to under it.
  [[nodiscard]] static R guess(const R& low, const R& lowHeight, const R& slope, const R& high,
                               const R& highHeight) {
    const R way = high - low, run = slope * way, twice = lowHeight + lowHeight;
    const R sum = run + twice;
    const R root = laneSqrt(sum * sum - (twice + twice) * highHeight);
    return low + way * (twice / (root - run));
  }

  /// Newton steps from `touch`, kept between `low` and `high`, in the lanes `live`. A step as small
  /// as the last one leaves an error of about its square.
  [[nodiscard]] R between(R low, R high, LaneMask<R> live, R touch) const {
    const R half(0.5);
    for (int i = 0; i < 30; ++i) {
      const R s = touch, height = at(s);
      const LaneMask<R> above = height > R(0.0);
      low = select(above, s, low);
      high = select(above, high, s);
      R next = s - height / slope(s);  // not inside where the slope is up, or none
      const LaneMask<R> inside = (next > low) & (next < high);
      next = select(inside, next, half * (low + high));
      setWhere(live, touch, next);
      live = live & !(laneAbs(next - s) < R(1e-5));
      if (!anyLane(live)) break;
    }
    return touch;
  }
};

}  // namespace ifa

#endif
