// SPDX-License-Identifier: Apache-2.0
// Which vertex touches the ground first over one segment of a flight, and when: as cubics have it.
#ifndef IFA_DYNAMICS_TOUCH_SEARCH_H
#define IFA_DYNAMICS_TOUCH_SEARCH_H

#include <algorithm>
#include <cstdint>

#include "dynamics/body_model.h"
#include "dynamics/chosen_vertices.h"
#include "dynamics/flight_path.h"
#include "dynamics/height_cubic.h"

namespace ifa {

/// Of vertices that touch at the same share of the segment the one of lowest rank counts: in each
/// chunk of the hull the one that ends lowest, then in the order of the hull, but the first of all
/// that may touch in the place of the one that ends lowest. Culling changes no bit: only what would
/// touch later by more than rounding could make of it is left out. The model must outlive it.
template <class R>
class TouchSearch {
 public:
  using Heights = PointHeights<R>;
  using Index = typename LaneTraits<R>::Index;
  using Mask = LaneMask<R>;

  /// @param bend  how far the way of a vertex may bend down, m. @param length  of the segment, s.
  /// @param near  lanes in which the body is low enough to touch
  TouchSearch(const BodyModel& body, const Heights& start, const Heights& end, const R& bend,
              const R& length, const Mask& near)
      : body_(body), a_(start), b_(end), bend_(bend), length_(length), near_(near) {
    for (begin_ = 0; begin_ < body.x.size(); begin_ += kChunk) {
      count_ = std::min(kChunk, body.x.size() - begin_);
      look();
    }
  }

  /// Share of the segment, 2 where nothing touches.
  [[nodiscard]] const R& share() const { return share_; }
  /// The vertex, body frame, m.
  [[nodiscard]] const Vec<R>& place() const { return place_; }

 private:
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;
  static constexpr std::size_t kChunk = 128;  ///< vertices looked at together
  /// Cubics are as near to the motion as this, in radii.
  static constexpr double kCubicError = 2e-3;

  /// The vertex of a chunk that ends lowest, of those of which an end is low, and the first of
  /// these: whole numbers.
  struct Lowest {
    R vertex, first;
    Mask any;
  };

  [[nodiscard]] Lowest measure();
  [[nodiscard]] R likelyTouch(const Lowest& lowest) const;
  [[nodiscard]] R lowestAt(const R& s) const;
  void listSooner(const R& solved);
  [[nodiscard]] Mask isLate(const HeightCubic<R>& height) const;
  [[nodiscard]] Mask staysUp(const HeightCubic<R>& height) const;
  [[nodiscard]] Vec<R> placeOf(const Index& vertex) const;
  void solve(const Mask& lanes, const Index& vertex, const R& number, const Lowest& lowest);
  void look();

  const BodyModel& body_;
  const Heights &a_, &b_;
  const R bend_, length_;
  const Mask near_;
  R share_{2.0}, rank_{-1e300};
  Vec<R> place_{};
  std::size_t begin_ = 0, count_ = 0;  ///< the chunk ...
  /// ... heights of its vertices over the centre at the segment's ends, and the lanes in which an
  /// end is so low that it may touch on the way ...
  alignas(kLanes * sizeof(double)) double h0_[kChunk * kLanes], h1_[kChunk * kLanes];
  std::uint8_t low_[kChunk];
  ChosenVertices<R, kChunk> sooner_;  ///< ... and those of each lane that may touch first
};

/// Measures the chunk.
template <class R>
auto TouchSearch<R>::measure() -> Lowest {
  const double* x = body_.rows.x.data() + begin_;
  const double* y = body_.rows.y.data() + begin_;
  const double* z = body_.rows.z.data() + begin_;
  const Vec<R> up0 = a_.up, up1 = b_.up;
  const R limit0 = bend_ - a_.z, limit1 = bend_ - b_.z, over = b_.z;
  const Mask near = near_;
  Lowest all{R(0.0), R(0.0), Mask(false)};
  R least(1e300);
  for (std::size_t i = 0; i < count_; ++i) {
    const R px(x[i]), py(y[i]), pz(z[i]);
    const R h0 = px * up0.x + py * up0.y + pz * up0.z, h1 = px * up1.x + py * up1.y + pz * up1.z;
    storeLanes(h0, h0_ + i * kLanes);
    storeLanes(h1, h1_ + i * kLanes);
    const Mask low = near & !((h0 > limit0) & (h1 > limit1));
    low_[i] = static_cast<std::uint8_t>(laneBits(low));
    const R number(static_cast<double>(i)), end = over + h1;
    setWhere(low & !all.any, all.first, number);
    all.any = all.any | low;
    const Mask lower = low & (end < least);
    setWhere(lower, least, end);
    setWhere(lower, all.vertex, number);
  }
  return all;
}

template <class R>
Vec<R> TouchSearch<R>::placeOf(const Index& vertex) const {
  return {fromTable<R>(body_.rows.x.data() + begin_, vertex),
          fromTable<R>(body_.rows.y.data() + begin_, vertex),
          fromTable<R>(body_.rows.z.data() + begin_, vertex)};
}

/// About where the vertex that ends lowest comes down, by a parabola; 1 where it ends above.
template <class R>
R TouchSearch<R>::likelyTouch(const Lowest& lowest) const {
  const R zero(0.0), one(1.0), two(2.0);
  const Index vertex = indexOf(lowest.vertex);
  const R h0 = a_.z + fromRows<R>(h0_, vertex), h1 = b_.z + fromRows<R>(h1_, vertex);
  const R rise = a_.rate(placeOf(vertex)) * length_, bend = h1 - h0 - rise;
  const R root = laneSqrt(laneMax(rise * rise - R(4.0) * bend * h0, zero));
  const Mask up = rise > zero;
  const R s = select(up, rise + root, two * h0) / select(up, zero - two * bend, root - rise);
  return select((h1 < zero) & (s >= zero) & (s <= one), s, one);
}

/// Of the vertices that may touch the one that is lowest at `s`, by the chord of its way.
template <class R>
R TouchSearch<R>::lowestAt(const R& s) const {
  R least(1e300), vertex(0.0);
  for (std::size_t i = 0; i < count_; ++i) {
    if (low_[i] == 0) continue;
    const R h0 = loadLanes<R>(h0_ + i * kLanes), h1 = loadLanes<R>(h1_ + i * kLanes);
    const R height = h0 + s * (h1 - h0);
    const Mask lower = lanesOf<R>(low_[i]) & (height < least);
    setWhere(lower, least, height);
    setWhere(lower, vertex, R(static_cast<double>(i)));
  }
  return vertex;
}

/// Lists what may touch before the first touch so far, but for the vertex that has been `solved`:
/// what is not above the ground, by more than its way may bend down, at the start and there.
template <class R>
void TouchSearch<R>::listSooner(const R& solved) {
  VertexSets sets(sooner_);
  const R one(1.0), s = laneMin(share_, one);
  const R bent = bend_ * s * s + R(kCubicError * body_.radius);
  const R limit0 = bent - a_.z;
  const R limit = bent + R(4.0) * bend_ * s * (one - s) - (a_.z + s * (b_.z - a_.z));
  for (std::size_t i = 0; i < count_; ++i) {
    if (low_[i] == 0) continue;
    const R h0 = loadLanes<R>(h0_ + i * kLanes), h1 = loadLanes<R>(h1_ + i * kLanes);
    const Mask above = (h0 > limit0) & (h0 + s * (h1 - h0) > limit);
    const Mask other = !(solved == R(static_cast<double>(i)));
    sets.add(lanesOf<R>(low_[i]) & other & !above, static_cast<int>(i));
  }
  sets.finish();
}

/// A vertex that is above the ground where the first touch is, and by more than the way there may
/// bend down, does not touch before.
template <class R>
LaneMask<R> TouchSearch<R>::isLate(const HeightCubic<R>& height) const {
  return (share_ <= R(1.0)) & (laneMin(height.h0, height.at(share_)) > bend_ * share_ * share_);
}

/// The cubic stays over the ground from where it may touch to a little beyond the first touch, by
/// more than rounding and the root finder could make of it: solved for, it would touch later.
/// Either all Bernstein coefficients on the way are over it, or the height rises from a start at
/// the ground to a peak over it and nowhere loses what it rose.
template <class R>
LaneMask<R> TouchSearch<R>::staysUp(const HeightCubic<R>& height) const {
  const R third(1.0 / 3), c1 = height.c1, c2 = height.c2, c3 = height.c3;
  const R s = laneMin(share_ * R(1 + 1e-5) + R(1e-5), R(1.0));
  const R bends = R(2.0) * laneAbs(c2) + R(3.0) * laneAbs(c3), start = laneAbs(height.h0);
  const R margin = R(2e-7) * (laneAbs(c1) + bends) + R(1e-12) * start;
  const R rise = c1 * s, bend = c2 * s * s;
  const R early = height.h0 + third * rise, late = early + third * (rise + bend);
  const Mask above = laneMin(laneMin(height.h0, early), laneMin(late, height.at(s))) > margin;
  const R middle = c1 + R(0.5) * c2 * s, end = c1 + (c2 + c3 * s) * s;
  const R least = laneMin(c1, laneMin(middle, end));
  return above | ((least > R(0.0)) & (least * c1 > R(2.0) * (margin + start) * bends));
}

/// Solves for the touch of a vertex of each lane, of `lanes`, where it may be the first.
template <class R>
void TouchSearch<R>::solve(const Mask& lanes, const Index& vertex, const R& number,
                           const Lowest& lowest) {
  const Vec<R> p = placeOf(vertex);
  const R h0 = a_.z + fromRows<R>(h0_, vertex), h1 = b_.z + fromRows<R>(h1_, vertex);
  const HeightCubic<R> height(h0, a_.rate(p), h1, b_.rate(p), length_);
  const Mask late = isLate(height), up = staysUp(height);
  const Mask open = lanes & !(late | up);
  if (!anyLane(open)) return;
  const R s = height.firstTouch(open), begin(static_cast<double>(begin_));
  const R place = select(number == lowest.first, lowest.vertex, number);
  const R rank = begin + select(number == lowest.vertex, R(-0.5), place);
  const Mask sooner = open & ((s < share_) | ((s == share_) & (rank < rank_)));
  setWhere(sooner, share_, s);
  setWhere(sooner, rank_, rank);
  setWhere(sooner, place_, p);
}

/// A vertex that is likely to be the first to touch spares looking at most of the others.
template <class R>
void TouchSearch<R>::look() {
  const Lowest lowest = measure();
  if (!anyLane(lowest.any)) return;
  const R likely = lowestAt(likelyTouch(lowest));
  solve(lowest.any, indexOf(likely), likely, lowest);
  listSooner(likely);
  for (int c = 0; c < sooner_.count(); ++c) {
    const Index vertex = sooner_.at(c);
    solve(sooner_.lanesWith(c), vertex, numberOf(vertex), lowest);
  }
}

}  // namespace ifa

#endif
