// SPDX-License-Identifier: Apache-2.0
// A lane type of as many doubles as a register of the instruction set has, by Highway. Only for
// lanes_of_target.h, which includes it anew for each instruction set. Multiply and add stay apart:
// a fused one has other bits.
#ifndef IFA_DYNAMICS_WIDE_LANE_H
#define IFA_DYNAMICS_WIDE_LANE_H

#include "dynamics/lane.h"

namespace ifa {

namespace hn = hwy::HWY_NAMESPACE;

using WideTag = hn::ScalableTag<double>;
using WideIndexTag = hn::RebindToSigned<WideTag>;

struct Wide {
  hn::Vec<WideTag> v;

  Wide() : v{} {}  // compilers make constructors out of it that are for any processor
  HWY_INLINE explicit Wide(double all) : v(hn::Set(WideTag(), all)) {}
  HWY_INLINE explicit Wide(hn::Vec<WideTag> lanes) : v(lanes) {}
};

struct WideMask {
  hn::Mask<WideTag> m;

  WideMask() : m{} {}
  HWY_INLINE explicit WideMask(bool all) : m(hn::FirstN(WideTag(), all ? hn::Lanes(WideTag()) : 0)) {}
  HWY_INLINE explicit WideMask(hn::Mask<WideTag> lanes) : m(lanes) {}
};

struct WideIndex {
  hn::Vec<WideIndexTag> v;
};

template <>
struct LaneTraits<Wide> {
  using Mask = WideMask;
  using Index = WideIndex;
  static constexpr int kLanes = static_cast<int>(HWY_LANES(double));
};

HWY_INLINE Wide operator+(const Wide& a, const Wide& b) { return Wide(hn::Add(a.v, b.v)); }
HWY_INLINE Wide operator-(const Wide& a, const Wide& b) { return Wide(hn::Sub(a.v, b.v)); }
HWY_INLINE Wide operator*(const Wide& a, const Wide& b) { return Wide(hn::Mul(a.v, b.v)); }
HWY_INLINE Wide operator/(const Wide& a, const Wide& b) { return Wide(hn::Div(a.v, b.v)); }
HWY_INLINE WideMask operator<(const Wide& a, const Wide& b) { return WideMask(hn::Lt(a.v, b.v)); }
HWY_INLINE WideMask operator>(const Wide& a, const Wide& b) { return WideMask(hn::Gt(a.v, b.v)); }
HWY_INLINE WideMask operator<=(const Wide& a, const Wide& b) { return WideMask(hn::Le(a.v, b.v)); }
HWY_INLINE WideMask operator>=(const Wide& a, const Wide& b) { return WideMask(hn::Ge(a.v, b.v)); }
HWY_INLINE WideMask operator==(const Wide& a, const Wide& b) { return WideMask(hn::Eq(a.v, b.v)); }
HWY_INLINE WideMask operator&(const WideMask& a, const WideMask& b) {
  return WideMask(hn::And(a.m, b.m));
}
HWY_INLINE WideMask operator|(const WideMask& a, const WideMask& b) {
  return WideMask(hn::Or(a.m, b.m));
}
HWY_INLINE WideMask operator!(const WideMask& a) { return WideMask(hn::Not(a.m)); }

HWY_INLINE bool anyLane(const WideMask& mask) { return !hn::AllFalse(WideTag(), mask.m); }
HWY_INLINE Wide select(const WideMask& mask, const Wide& yes, const Wide& no) {
  return Wide(hn::IfThenElse(mask.m, yes.v, no.v));
}
HWY_INLINE Wide laneMin(const Wide& a, const Wide& b) { return select(a < b, a, b); }
HWY_INLINE Wide laneMax(const Wide& a, const Wide& b) { return select(a > b, a, b); }
HWY_INLINE Wide laneSqrt(const Wide& a) { return Wide(hn::Sqrt(a.v)); }
HWY_INLINE Wide laneAbs(const Wide& a) { return Wide(hn::Abs(a.v)); }

HWY_INLINE unsigned laneBits(const WideMask& mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(WideTag(), mask.m, bits);
  return bits[0];
}
template <>
HWY_INLINE WideMask lanesOf<Wide>(unsigned bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
  return WideMask(hn::LoadMaskBits(WideTag(), bytes));
}

template <>
HWY_INLINE Wide loadLanes<Wide>(const double* from) {
  return Wide(hn::Load(WideTag(), from));
}
HWY_INLINE void storeLanes(const Wide& value, double* to) { hn::Store(value.v, WideTag(), to); }
HWY_INLINE double laneOf(const Wide& value, std::size_t lane) {
  alignas(64) double lanes[LaneTraits<Wide>::kLanes];
  storeLanes(value, lanes);
  return lanes[lane];
}
template <>
HWY_INLINE WideIndex loadIndices<Wide>(const std::int64_t* from) {
  return {hn::Load(WideIndexTag(), from)};
}
HWY_INLINE WideIndex orZero(const WideMask& mask, const WideIndex& index) {
  return {hn::IfThenElseZero(hn::RebindMask(WideIndexTag(), mask.m), index.v)};
}
template <>
HWY_INLINE Wide fromTable<Wide>(const double* table, const WideIndex& index) {
  return Wide(hn::GatherIndex(WideTag(), table, index.v));
}
template <>
HWY_INLINE Wide fromRows<Wide>(const double* rows, const WideIndex& row) {
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(LaneTraits<Wide>::kLanes));
  const auto lane = hn::Iota(WideIndexTag(), 0);
  return Wide(hn::GatherIndex(WideTag(), rows, hn::Add(hn::ShiftLeft<kShift>(row.v), lane)));
}

}  // namespace ifa

#endif
