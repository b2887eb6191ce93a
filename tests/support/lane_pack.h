// SPDX-License-Identifier: Apache-2.0
// N lanes as an array of doubles: a lane type for any machine, slow and plain.
#pragma once

#include <array>
#include <cstddef>

#include "dynamics/lane.h"

namespace ifa {

template <std::size_t N>
struct PackMask {
  std::array<bool, N> lanes{};

  PackMask() = default;
  explicit PackMask(bool all) { lanes.fill(all); }
};

template <std::size_t N>
struct Pack {
  std::array<double, N> lanes{};

  Pack() = default;
  explicit Pack(double all) { lanes.fill(all); }
};

template <std::size_t N>
struct LaneTraits<Pack<N>> {
  using Mask = PackMask<N>;
  static constexpr int kLanes = N;
};

/// `f` of every lane.
template <class To, class F>
To eachLane(const F& f) {
  To result;
  for (std::size_t i = 0; i < result.lanes.size(); ++i) result.lanes[i] = f(i);
  return result;
}

template <std::size_t N>
Pack<N> operator+(const Pack<N>& a, const Pack<N>& b) {
  return eachLane<Pack<N>>([&](std::size_t i) { return a.lanes[i] + b.lanes[i]; });
}
template <std::size_t N>
Pack<N> operator-(const Pack<N>& a, const Pack<N>& b) {
  return eachLane<Pack<N>>([&](std::size_t i) { return a.lanes[i] - b.lanes[i]; });
}
template <std::size_t N>
Pack<N> operator*(const Pack<N>& a, const Pack<N>& b) {
  return eachLane<Pack<N>>([&](std::size_t i) { return a.lanes[i] * b.lanes[i]; });
}
template <std::size_t N>
Pack<N> operator/(const Pack<N>& a, const Pack<N>& b) {
  return eachLane<Pack<N>>([&](std::size_t i) { return a.lanes[i] / b.lanes[i]; });
}
template <std::size_t N>
PackMask<N> operator<(const Pack<N>& a, const Pack<N>& b) {
  return eachLane<PackMask<N>>([&](std::size_t i) { return a.lanes[i] < b.lanes[i]; });
}
template <std::size_t N>
PackMask<N> operator>(const Pack<N>& a, const Pack<N>& b) {
  return b < a;
}
template <std::size_t N>
PackMask<N> operator<=(const Pack<N>& a, const Pack<N>& b) {
  return eachLane<PackMask<N>>([&](std::size_t i) { return a.lanes[i] <= b.lanes[i]; });
}
template <std::size_t N>
PackMask<N> operator>=(const Pack<N>& a, const Pack<N>& b) {
  return b <= a;
}
template <std::size_t N>
PackMask<N> operator&(const PackMask<N>& a, const PackMask<N>& b) {
  return eachLane<PackMask<N>>([&](std::size_t i) { return a.lanes[i] && b.lanes[i]; });
}
template <std::size_t N>
PackMask<N> operator|(const PackMask<N>& a, const PackMask<N>& b) {
  return eachLane<PackMask<N>>([&](std::size_t i) { return a.lanes[i] || b.lanes[i]; });
}
template <std::size_t N>
PackMask<N> operator!(const PackMask<N>& a) {
  return eachLane<PackMask<N>>([&](std::size_t i) { return !a.lanes[i]; });
}

template <std::size_t N>
bool anyLane(const PackMask<N>& mask) {
  bool any = false;
  for (const bool lane : mask.lanes) any = any || lane;
  return any;
}
template <std::size_t N>
Pack<N> select(const PackMask<N>& mask, const Pack<N>& yes, const Pack<N>& no) {
  return eachLane<Pack<N>>(
      [&](std::size_t i) { return mask.lanes[i] ? yes.lanes[i] : no.lanes[i]; });
}
template <std::size_t N>
Pack<N> laneMin(const Pack<N>& a, const Pack<N>& b) {
  return select(a < b, a, b);
}
template <std::size_t N>
Pack<N> laneMax(const Pack<N>& a, const Pack<N>& b) {
  return select(a > b, a, b);
}
template <std::size_t N>
Pack<N> laneSqrt(const Pack<N>& a) {
  return eachLane<Pack<N>>([&](std::size_t i) { return laneSqrt(a.lanes[i]); });
}
template <std::size_t N>
Pack<N> laneAbs(const Pack<N>& a) {
  return eachLane<Pack<N>>([&](std::size_t i) { return laneAbs(a.lanes[i]); });
}

}  // namespace ifa
