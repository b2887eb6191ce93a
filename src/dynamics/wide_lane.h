// SPDX-License-Identifier: Apache-2.0
// A lane type of a few registers of doubles, by Highway. Only for lanes_of_target.h, which includes
// it anew for each instruction set. Multiply and add stay apart: a fused one has other bits.
#ifndef IFA_DYNAMICS_WIDE_LANE_H
#define IFA_DYNAMICS_WIDE_LANE_H

#include "dynamics/lane.h"

namespace ifa {

namespace hn = hwy::HWY_NAMESPACE;

using WideTag = hn::ScalableTag<double>;
using WideIndexTag = hn::RebindToSigned<WideTag>;

/// Registers of a lane type: what one waits for, another does meanwhile; with two of AVX-512 more
/// is lost to lanes that wait for each other than is gained.
inline constexpr std::size_t kRegisters = HWY_TARGET == HWY_AVX2 ? 2 : 1;
inline constexpr std::size_t kInRegister = HWY_LANES(double);

struct Wide {
  hn::Vec<WideTag> v[kRegisters];

  Wide() = default;
  HWY_INLINE explicit Wide(double all) {
    for (auto& part : v) part = hn::Set(WideTag(), all);
  }
};

struct WideMask {
  hn::Mask<WideTag> m[kRegisters];

  WideMask() = default;
  HWY_INLINE explicit WideMask(bool all) {
    for (auto& part : m) part = hn::FirstN(WideTag(), all ? kInRegister : 0);
  }
};

struct WideIndex {
  hn::Vec<WideIndexTag> v[kRegisters];
};

template <>
struct LaneTraits<Wide> {
  using Mask = WideMask;
  using Index = WideIndex;
  static constexpr int kLanes = static_cast<int>(kRegisters * kInRegister);
};

#define IFA_WIDE(Result, Name, Parameters, Member, Expression)                  \
  HWY_INLINE Result Name Parameters {                                           \
    Result result;                                                              \
    for (std::size_t i = 0; i < kRegisters; ++i) result.Member[i] = Expression; \
    return result;                                                              \
  }
IFA_WIDE(Wide, operator+, (const Wide& a, const Wide& b), v, hn::Add(a.v[i], b.v[i]))
IFA_WIDE(Wide, operator-, (const Wide& a, const Wide& b), v, hn::Sub(a.v[i], b.v[i]))
IFA_WIDE(Wide, operator*, (const Wide& a, const Wide& b), v, hn::Mul(a.v[i], b.v[i]))
IFA_WIDE(Wide, operator/, (const Wide& a, const Wide& b), v, hn::Div(a.v[i], b.v[i]))
IFA_WIDE(Wide, laneSqrt, (const Wide& a), v, hn::Sqrt(a.v[i]))
IFA_WIDE(Wide, laneAbs, (const Wide& a), v, hn::Abs(a.v[i]))
IFA_WIDE(WideMask, operator<, (const Wide& a, const Wide& b), m, hn::Lt(a.v[i], b.v[i]))
IFA_WIDE(WideMask, operator>, (const Wide& a, const Wide& b), m, hn::Gt(a.v[i], b.v[i]))
IFA_WIDE(WideMask, operator<=, (const Wide& a, const Wide& b), m, hn::Le(a.v[i], b.v[i]))
IFA_WIDE(WideMask, operator>=, (const Wide& a, const Wide& b), m, hn::Ge(a.v[i], b.v[i]))
IFA_WIDE(WideMask, operator==, (const Wide& a, const Wide& b), m, hn::Eq(a.v[i], b.v[i]))
IFA_WIDE(WideMask, operator&, (const WideMask& a, const WideMask& b), m, hn::And(a.m[i], b.m[i]))
IFA_WIDE(WideMask, operator|, (const WideMask& a, const WideMask& b), m, hn::Or(a.m[i], b.m[i]))
IFA_WIDE(WideMask, operator!, (const WideMask& a), m, hn::Not(a.m[i]))
IFA_WIDE(Wide, select, (const WideMask& mask, const Wide& yes, const Wide& no), v,
         hn::IfThenElse(mask.m[i], yes.v[i], no.v[i]))
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
// These instructions do what laneMin() and laneMax() of doubles do, zeros of both signs included.
IFA_WIDE(Wide, laneMin, (const Wide& a, const Wide& b), v, hn::Min(a.v[i], b.v[i]))
IFA_WIDE(Wide, laneMax, (const Wide& a, const Wide& b), v, hn::Max(a.v[i], b.v[i]))
#else
HWY_INLINE Wide laneMin(const Wide& a, const Wide& b) { return select(a < b, a, b); }
HWY_INLINE Wide laneMax(const Wide& a, const Wide& b) { return select(a > b, a, b); }
#endif

HWY_INLINE bool anyLane(const WideMask& mask) {
  auto any = mask.m[0];
  for (std::size_t i = 1; i < kRegisters; ++i) any = hn::Or(any, mask.m[i]);
  return !hn::AllFalse(WideTag(), any);
}
HWY_INLINE unsigned laneBits(const WideMask& mask) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < kRegisters; ++i) {
#if HWY_TARGET == HWY_AVX3
    bits |= static_cast<unsigned>(mask.m[i].raw) << (i * kInRegister);
#elif HWY_TARGET == HWY_AVX2
    bits |= static_cast<unsigned>(_mm256_movemask_pd(mask.m[i].raw)) << (i * kInRegister);
#else
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(WideTag(), mask.m[i], part);
    bits |= static_cast<unsigned>(part[0]) << (i * kInRegister);
#endif
  }
  return bits;
}
template <>
HWY_INLINE WideMask lanesOf<Wide>(unsigned bits) {
  WideMask mask;
  for (std::size_t i = 0; i < kRegisters; ++i) {
    const std::uint8_t part[8] = {static_cast<std::uint8_t>(bits >> (i * kInRegister))};
    mask.m[i] = hn::LoadMaskBits(WideTag(), part);
  }
  return mask;
}

template <>
IFA_WIDE(Wide, loadLanes<Wide>, (const double* from), v,
         hn::Load(WideTag(), from + i * kInRegister))
HWY_INLINE void storeLanes(const Wide& value, double* to) {
  for (std::size_t i = 0; i < kRegisters; ++i) {
    hn::Store(value.v[i], WideTag(), to + i * kInRegister);
  }
}
HWY_INLINE double laneOf(const Wide& value, std::size_t lane) {
  alignas(kRegisters * kInRegister * sizeof(double)) double lanes[kRegisters * kInRegister];
  storeLanes(value, lanes);
  return lanes[lane];
}
template <>
IFA_WIDE(WideIndex, loadIndices<Wide>, (const std::int64_t* from), v,
         hn::Load(WideIndexTag(), from + i * kInRegister))
IFA_WIDE(WideIndex, orZero, (const WideMask& mask, const WideIndex& index), v,
         hn::IfThenElseZero(hn::RebindMask(WideIndexTag(), mask.m[i]), index.v[i]))
    IFA_WIDE(WideIndex, indexOf, (const Wide& number), v,
             hn::ConvertTo(WideIndexTag(), number.v[i]))
        IFA_WIDE(Wide, numberOf, (const WideIndex& index), v,
                 hn::ConvertTo(WideTag(), index.v[i])) template <>
        IFA_WIDE(Wide, fromTable<Wide>, (const double* table, const WideIndex& index), v,
                 hn::GatherIndex(WideTag(), table, index.v[i]))
        template <int kTimes>
        HWY_INLINE WideIndex times(const WideIndex& index) {
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(kTimes));
  static_assert(1 << kShift == kTimes);
  WideIndex result;
  for (std::size_t i = 0; i < kRegisters; ++i) result.v[i] = hn::ShiftLeft<kShift>(index.v[i]);
  return result;
}
template <>
HWY_INLINE Wide fromRows<Wide>(const double* rows, const WideIndex& row) {
  constexpr int kShift = std::countr_zero(kRegisters * kInRegister);
  WideIndex index;
  for (std::size_t i = 0; i < kRegisters; ++i) {
    const auto lane = hn::Iota(WideIndexTag(), static_cast<std::int64_t>(i * kInRegister));
    index.v[i] = hn::Add(hn::ShiftLeft<kShift>(row.v[i]), lane);
  }
  return fromTable<Wide>(rows, index);
}
#undef IFA_WIDE

HWY_INLINE void storeIndices(const WideIndex& index, std::int64_t* to) {
  for (std::size_t i = 0; i < kRegisters; ++i) {
    hn::Store(index.v[i], WideIndexTag(), to + i * kInRegister);
  }
}
/// Sets of bits.
HWY_INLINE WideMask hasBits(const WideIndex& sets) {
  WideMask result;
  for (std::size_t i = 0; i < kRegisters; ++i) {
    const auto none = hn::Eq(sets.v[i], hn::Zero(WideIndexTag()));
    result.m[i] = hn::Not(hn::RebindMask(WideTag(), none));
  }
  return result;
}
/// Takes the lowest bit out of each set and tells its number; of an empty set anything.
HWY_INLINE Wide takeLowestBit(WideIndex& sets) {
  const WideIndexTag d;
  Wide result;
  for (std::size_t i = 0; i < kRegisters; ++i) {
    const auto lowest = hn::And(sets.v[i], hn::Neg(sets.v[i]));
    sets.v[i] = hn::Xor(sets.v[i], lowest);
    // A power of two as a double tells its exponent.
    const auto exponent = hn::ShiftRight<52>(hn::BitCast(d, hn::ConvertTo(WideTag(), lowest)));
    result.v[i] = hn::Sub(hn::ConvertTo(WideTag(), exponent), hn::Set(WideTag(), 1023.0));
  }
  return result;
}

/// Turns a square of numbers about its diagonal.
HWY_INLINE void transpose(hn::Vec<WideTag> (&square)[kInRegister]) {
  const WideTag d;
#if HWY_TARGET == HWY_AVX3
  hn::Vec<WideTag> pair[8];
  for (std::size_t i = 0; i < 8; i += 2) {
    pair[i] = hn::InterleaveLower(d, square[i], square[i + 1]);
    pair[i + 1] = hn::InterleaveUpper(d, square[i], square[i + 1]);
  }
  // Highway has no way to join blocks of 128 bits like this.
  const auto join = [](auto a, auto b, auto which) HWY_ATTR {
    return hn::Vec<WideTag>{_mm512_shuffle_f64x2(a.raw, b.raw, decltype(which)::value)};
  };
  constexpr std::integral_constant<int, 0x88> kEven{};
  constexpr std::integral_constant<int, 0xdd> kOdd{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto a = join(pair[i], pair[i + 2], kEven), b = join(pair[i], pair[i + 2], kOdd);
    const auto c = join(pair[i + 4], pair[i + 6], kEven), e = join(pair[i + 4], pair[i + 6], kOdd);
    square[i] = join(a, c, kEven);
    square[i + 4] = join(a, c, kOdd);
    square[i + 2] = join(b, e, kEven);
    square[i + 6] = join(b, e, kOdd);
  }
#elif HWY_TARGET == HWY_AVX2
  const auto a = hn::InterleaveLower(d, square[0], square[1]);
  const auto b = hn::InterleaveUpper(d, square[0], square[1]);
  const auto c = hn::InterleaveLower(d, square[2], square[3]);
  const auto e = hn::InterleaveUpper(d, square[2], square[3]);
  square[0] = hn::ConcatLowerLower(d, c, a);
  square[1] = hn::ConcatLowerLower(d, e, b);
  square[2] = hn::ConcatUpperUpper(d, c, a);
  square[3] = hn::ConcatUpperUpper(d, e, b);
#else
  alignas(64) double from[kInRegister][kInRegister], to[kInRegister][kInRegister];
  for (std::size_t i = 0; i < kInRegister; ++i) hn::Store(square[i], d, from[i]);
  for (std::size_t i = 0; i < kInRegister; ++i) {
    for (std::size_t j = 0; j < kInRegister; ++j) to[j][i] = from[i][j];
  }
  for (std::size_t i = 0; i < kInRegister; ++i) square[i] = hn::Load(d, to[i]);
#endif
}

/// Numbers that are moved together between lanes and memory.
inline constexpr std::size_t kBlock = 8;

/// Takes kBlock numbers of each lane, which lie together at an aligned place, `at` numbers from
/// `from`, into rows of lanes.
HWY_INLINE void loadBlock(const double* const* from, std::size_t at, double* to) {
  const WideTag d;
  for (std::size_t i = 0; i < kRegisters; ++i) {
    for (std::size_t field = 0; field < kBlock; field += kInRegister) {
      hn::Vec<WideTag> square[kInRegister];
      for (std::size_t k = 0; k < kInRegister; ++k) {
        square[k] = hn::Load(d, from[i * kInRegister + k] + at + field);
      }
      transpose(square);
      for (std::size_t k = 0; k < kInRegister; ++k) {
        hn::Store(square[k], d, to + ((field + k) * kRegisters + i) * kInRegister);
      }
    }
  }
}
/// The way back.
HWY_INLINE void storeBlock(const double* from, double* const* to, std::size_t at) {
  const WideTag d;
  for (std::size_t i = 0; i < kRegisters; ++i) {
    for (std::size_t field = 0; field < kBlock; field += kInRegister) {
      hn::Vec<WideTag> square[kInRegister];
      for (std::size_t k = 0; k < kInRegister; ++k) {
        square[k] = hn::Load(d, from + ((field + k) * kRegisters + i) * kInRegister);
      }
      transpose(square);
      for (std::size_t k = 0; k < kInRegister; ++k) {
        hn::Store(square[k], d, to[i * kInRegister + k] + at + field);
      }
    }
  }
}

}  // namespace ifa

#endif
