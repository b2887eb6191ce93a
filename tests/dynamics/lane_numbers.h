// SPDX-License-Identifier: Apache-2.0
// Puts a state of one lane into a lane of many, and tells whether the two still have the same bits.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "dynamics/contact_solver.h"
#include "dynamics/free_rotation.h"
#include "dynamics/impact_law.h"
#include "dynamics/midpoint_step.h"
#include "support/lane_pack.h"

namespace ifa {

template <class R>
using Numbers = std::vector<R*>;

template <class R>
Numbers<R> joined(std::initializer_list<Numbers<R>> parts) {
  Numbers<R> all;
  for (const Numbers<R>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

template <class R>
Numbers<R> numbersOf(Vec<R>& v) {
  return {&v.x, &v.y, &v.z};
}
template <class R>
Numbers<R> numbersOf(Quat<R>& q) {
  return {&q.w, &q.x, &q.y, &q.z};
}
template <class R>
Numbers<R> numbersOf(Rotation<R>& r) {
  return joined({numbersOf(r.rows[0]), numbersOf(r.rows[1]), numbersOf(r.rows[2])});
}
template <class R>
Numbers<R> numbersOf(SinCos<R>& s) {
  return {&s.sine, &s.cosine};
}
template <class R>
Numbers<R> numbersOf(Spin<R>& s) {
  return joined({numbersOf(s.q), numbersOf(s.w)});
}
template <class R>
Numbers<R> numbersOf(KernelState<R>& s) {
  return joined({Numbers<R>{&s.time}, numbersOf(s.position), numbersOf(s.q), numbersOf(s.velocity),
                 numbersOf(s.w)});
}
template <class R>
Numbers<R> numbersOf(ContactPoint<R>& p) {
  return joined({Numbers<R>{&p.gap, &p.rate}, numbersOf(p.place), numbersOf(p.r),
                 numbersOf(p.target), numbersOf(p.impulse)});
}
template <class R>
Numbers<R> numbersOf(ContactSolver<R>& s) {
  Numbers<R> all = joined({numbersOf(s.moment), numbersOf(s.spinTarget), {&s.rollingArm}});
  for (int k = 0; k < s.count; ++k) all = joined({all, numbersOf(s.points[k])});
  return all;
}
template <class R>
Numbers<R> numbersOf(Impact<R>& i) {
  return joined({numbersOf(i.velocity), numbersOf(i.w), numbersOf(i.impulse)});
}
template <class R>
Numbers<R> numbersOf(Midpoint<R>& m) {
  return joined(
      {numbersOf(m.velocity), numbersOf(m.w), numbersOf(m.momentum), numbersOf(m.impulse)});
}

template <template <class> class S, std::size_t N>
void setLane(S<Pack<N>>& all, std::size_t lane, S<double> one) {
  const Numbers<Pack<N>> to = numbersOf(all);
  const Numbers<double> from = numbersOf(one);
  for (std::size_t i = 0; i < from.size(); ++i) to[i]->lanes[lane] = *from[i];
}
/// A lane with fewer points than others does without the rest.
template <std::size_t N>
void setLane(ContactSolver<Pack<N>>& all, std::size_t lane, ContactSolver<double> one) {
  const int count = all.count;
  all.count = one.count;
  const Numbers<Pack<N>> to = numbersOf(all);
  const Numbers<double> from = numbersOf(one);
  for (std::size_t i = 0; i < from.size(); ++i) to[i]->lanes[lane] = *from[i];
  for (int k = 0; k < ContactSolver<double>::kMaxPoints; ++k) {
    all.points[k].here.lanes[lane] = k < one.count;
  }
  all.count = std::max(count, one.count);
}

/// Bits, not values: the sign of a zero counts.
inline bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <std::size_t N>
void expectLane(const Pack<N>& all, std::size_t lane, double one) {
  EXPECT_PRED2(sameBits, all.lanes[lane], one) << "lane " << lane << " of " << N;
}
template <template <class> class S, std::size_t N>
void expectLane(S<Pack<N>> all, std::size_t lane, S<double> one) {
  const Numbers<Pack<N>> many = numbersOf(all);
  const Numbers<double> few = numbersOf(one);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_PRED2(sameBits, many[i]->lanes[lane], *few[i])
        << "number " << i << ", lane " << lane << " of " << N;
  }
}

}  // namespace ifa
