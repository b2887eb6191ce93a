// SPDX-License-Identifier: Apache-2.0
// The number type over which the kernel is written once: one lane is a double, many lanes a wide
// register. Only operations whose bits are the same on every processor are offered (+ - * / sqrt,
// comparisons). Conditions are masks, with & | and !, so that what a lane gets does not depend on
// its neighbours: every lane may go through both branches, and keeps what its own condition says. A
// loop goes on until no lane is live, and leaves those alone that are not. A branch that no lane
// needs may be left out (anyLane): that saves time and changes no bit.
#ifndef IFA_DYNAMICS_LANE_H
#define IFA_DYNAMICS_LANE_H

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace ifa {

/// Mask type and number of lanes of a lane type. Mask(true) has all lanes set; a lane type made of
/// nothing, R(), is 0. Index holds a whole number for each lane.
template <class R>
struct LaneTraits;
template <>
struct LaneTraits<double> {
  using Mask = bool;
  using Index = std::int64_t;
  static constexpr int kLanes = 1;
};
template <class R>
using LaneMask = typename LaneTraits<R>::Mask;

inline bool anyLane(bool mask) { return mask; }
inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline double laneMin(double a, double b) { return a < b ? a : b; }
inline double laneMax(double a, double b) { return a > b ? a : b; }
inline double laneSqrt(double a) { return std::sqrt(a); }
inline double laneAbs(double a) { return std::fabs(a); }

/// Gives `target` a new value in the lanes of `mask`.
template <class M, class T>
void setWhere(const M& mask, T& target, const T& value) {
  target = select(mask, value, target);
}
template <class T>
void setWhere(bool mask, T& target, const T& value) {
  if (mask) target = value;
}

/// Lane i as bit i, and back.
inline unsigned laneBits(bool mask) { return mask ? 1 : 0; }
template <class R>
LaneMask<R> lanesOf(unsigned bits);
template <>
inline bool lanesOf<double>(unsigned bits) {
  return bits != 0;
}

/// Lanes in memory, one after the other, from an address that is a multiple of their size on.
template <class R>
R loadLanes(const double* from);
template <>
inline double loadLanes<double>(const double* from) {
  return *from;
}
inline void storeLanes(double value, double* to) { *to = value; }
inline double laneOf(double value, std::size_t) { return value; }
/// The same for whole numbers.
template <class R>
typename LaneTraits<R>::Index loadIndices(const std::int64_t* from);
template <>
inline std::int64_t loadIndices<double>(const std::int64_t* from) {
  return *from;
}
inline std::int64_t orZero(bool mask, std::int64_t index) { return mask ? index : 0; }
inline void storeIndices(std::int64_t index, std::int64_t* to) { *to = index; }
/// Sets of bits: whether there are any, and the number of the lowest, which is taken out.
inline bool hasBits(std::int64_t sets) { return sets != 0; }
inline double takeLowestBit(std::int64_t& sets) {
  const int number = std::countr_zero(static_cast<std::uint64_t>(sets));
  sets &= sets - 1;
  return number;
}
/// A whole number told as a double, and the way back.
inline std::int64_t indexOf(double number) { return static_cast<std::int64_t>(number); }
inline double numberOf(std::int64_t index) { return static_cast<double>(index); }

/// Each lane's own entry of a table.
template <class R>
R fromTable(const double* table, const typename LaneTraits<R>::Index& index);
template <>
inline double fromTable<double>(const double* table, const std::int64_t& index) {
  return table[index];
}
/// Each lane's own row of what storeLanes() put one after the other.
template <class R>
R fromRows(const double* rows, const typename LaneTraits<R>::Index& row);
template <>
inline double fromRows<double>(const double* rows, const std::int64_t& row) {
  return rows[row];
}

/// A vector of three lanes.
template <class R>
struct Vec {
  R x, y, z;
};

template <class R>
Vec<R> operator+(const Vec<R>& a, const Vec<R>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
Vec<R> operator-(const Vec<R>& a, const Vec<R>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
Vec<R> operator*(const Vec<R>& a, R s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class R>
R dot(const Vec<R>& a, const Vec<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
Vec<R> cross(const Vec<R>& a, const Vec<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R>
Vec<R> select(const LaneMask<R>& mask, const Vec<R>& yes, const Vec<R>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// A quaternion w + x i + y j + z k.
template <class R>
struct Quat {
  R w, x, y, z;
};

/// Product with the pure quaternion of `v`: q (0, v).
template <class R>
Quat<R> timesPure(const Quat<R>& q, const Vec<R>& v) {
  return {R(0.0) - q.x * v.x - q.y * v.y - q.z * v.z, q.w * v.x + q.y * v.z - q.z * v.y,
          q.w * v.y + q.z * v.x - q.x * v.z, q.w * v.z + q.x * v.y - q.y * v.x};
}
template <class R>
Quat<R> operator+(const Quat<R>& a, const Quat<R>& b) {
  return {a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
Quat<R> operator*(const Quat<R>& a, R s) {
  return {a.w * s, a.x * s, a.y * s, a.z * s};
}
template <class R>
Quat<R> normalised(const Quat<R>& q) {
  return q * (R(1.0) / laneSqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z));
}
/// The same for a quaternion whose squared length is within about 1e-3 of 1, to 1e-15 or so.
template <class R>
Quat<R> renormalised(const Quat<R>& q) {
  const R d = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - R(1.0);
  return q * (R(1.0) - d * (R(0.5) - d * (R(0.375) - d * (R(0.3125) - d * R(0.2734375)))));
}
template <class R>
Quat<R> select(const LaneMask<R>& mask, const Quat<R>& yes, const Quat<R>& no) {
  return {select(mask, yes.w, no.w), select(mask, yes.x, no.x), select(mask, yes.y, no.y),
          select(mask, yes.z, no.z)};
}

/// A rotation matrix by rows: `rows[2]` is the world's z axis seen from the body.
template <class R>
struct Rotation {
  Vec<R> rows[3];

  explicit Rotation(const Quat<R>& q) {
    const R xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const R xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    const R wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    const R one(1.0), two(2.0);
    rows[0] = {one - two * (yy + zz), two * (xy - wz), two * (xz + wy)};
    rows[1] = {two * (xy + wz), one - two * (xx + zz), two * (yz - wx)};
    rows[2] = {two * (xz - wy), two * (yz + wx), one - two * (xx + yy)};
  }
  /// Body to world.
  [[nodiscard]] Vec<R> operator*(const Vec<R>& v) const {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }
  /// World to body.
  [[nodiscard]] Vec<R> transposed(const Vec<R>& v) const {
    return rows[0] * v.x + rows[1] * v.y + rows[2] * v.z;
  }
};

}  // namespace ifa

#endif
