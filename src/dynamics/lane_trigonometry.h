// SPDX-License-Identifier: Apache-2.0
// Sine and cosine over lanes with the same bits everywhere: range reduction by pi/2, then Taylor
// series.
#ifndef IFA_DYNAMICS_LANE_TRIGONOMETRY_H
#define IFA_DYNAMICS_LANE_TRIGONOMETRY_H

#include "dynamics/lane.h"

namespace ifa {

template <class R>
struct SinCos {
  R sine, cosine;
};

/// Good to about 1e-15 for |x| up to some thousand radians.
template <class R>
SinCos<R> laneSinCos(R x) {
  // Adding and taking away 1.5 * 2^52 rounds to an integer.
  const R magic(6755399441055744.0);
  const R n = (x * R(0.63661977236758134) + magic) - magic;
  // pi/2 in three parts of 33 bits, so that n times the first two is exact.
  const R r = ((x - n * R(1.57079632673412561417)) - n * R(6.07710050630396597660e-11)) -
              n * R(2.02226624879595063154e-21);
  const R r2 = r * r;
  R s(-7.6471637318198165e-13), c(4.7794773323873853e-14);
  constexpr double kSine[] = {1.6059043836821613e-10, -2.5052108385441720e-08,
                              2.7557319223985893e-06, -1.9841269841269841e-04,
                              8.3333333333333333e-03, -1.6666666666666667e-01};
  constexpr double kCosine[] = {-1.1470745597729725e-11, 2.0876756987868099e-09,
                                -2.7557319223985888e-07, 2.4801587301587302e-05,
                                -1.3888888888888889e-03, 4.1666666666666667e-02,
                                -5.0000000000000000e-01};
  for (const double k : kSine) s = s * r2 + R(k);
  for (const double k : kCosine) c = c * r2 + R(k);
  s = r + r * (r2 * s);
  c = R(1.0) + r2 * c;
  // Quadrant -2 .. 2.
  const R quadrant = n - R(4.0) * ((n * R(0.25) + magic) - magic);
  const auto odd = laneAbs(laneAbs(quadrant) - R(1.0)) < R(0.5);
  const auto half = laneAbs(quadrant) > R(1.5);
  const R sine = select(odd, c * quadrant, select(half, R(0.0) - s, s));
  const R cosine = select(odd, (R(0.0) - s) * quadrant, select(half, R(0.0) - c, c));
  return {sine, cosine};
}

}  // namespace ifa

#endif
