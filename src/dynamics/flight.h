// SPDX-License-Identifier: Apache-2.0
// Ballistic flight, exact, with the first vertex that touches the ground.
#ifndef IFA_DYNAMICS_FLIGHT_H
#define IFA_DYNAMICS_FLIGHT_H

#include <algorithm>
#include <type_traits>
#include <utility>

#include "dynamics/body_model.h"
#include "dynamics/chosen_vertices.h"
#include "dynamics/flight_path.h"
#include "dynamics/height_cubic.h"
#include "dynamics/simulation.h"

namespace ifa {

/// One segment of a flight, with its first touch. Not to be shared between threads: it remembers
/// the state that was asked for last.
template <class R>
class FlightSegment {
 public:
  /// At most `longest` seconds.
  FlightSegment(const BodyModel& body, const KernelState<R>& start,
                const std::type_identity_t<R>& longest)
      : body_(body), path_(body, start), length_(path_.length(longest)) {
    last_ = {length_, path_.at(length_)};
  }

  [[nodiscard]] const R& length() const { return length_; }

  /// State `t` seconds after the segment's start.
  [[nodiscard]] KernelState<R> at(const R& t) const {
    const LaneMask<R> other = !(t == last_.t);
    KernelState<R> state = last_.state;
    if (anyLane(other)) setWhere(other, state, path_.at(t));
    return state;
  }

  /// Seconds from the start to the first touch; larger than length() when nothing touches.
  [[nodiscard]] R firstTouch() const;

 private:
  using Heights = PointHeights<R>;
  static constexpr std::size_t kLanes = LaneTraits<R>::kLanes;
  static constexpr std::size_t kChunk = 128;  ///< vertices looked at together

  /// Heights of a chunk's vertices over the centre at the segment's ends, and each lane's own list
  /// of those that may touch.
  struct Candidates {
    ChosenVertices<R, kChunk> vertices;
    alignas(kLanes * sizeof(double)) double h0[kChunk * kLanes], h1[kChunk * kLanes];
    std::size_t begin, count;  ///< the chunk
  };
  /// What the segment's ends say.
  struct Ends {
    Heights a, b;
    R bend;
    R limit0, limit1;  ///< of heights over the centre that are low
    LaneMask<R> near;  ///< lanes in which the body is low enough to touch
  };
  /// The first touch so far: share of the segment, 2 for none, and the vertex.
  struct First {
    R share;
    Vec<R> place;
  };
  /// The vertex of a chunk that ends lowest, of those of which an end is low, and the first of
  /// these: whole numbers.
  struct Lowest {
    R vertex, first;
    LaneMask<R> any;
  };

  void measure(const Ends& ends, Candidates& found) const;
  [[nodiscard]] Lowest lowest(const Ends& ends, const Candidates& found) const;
  [[nodiscard]] LaneMask<R> isLow(const Ends& ends, const Candidates& found, std::size_t i) const;
  [[nodiscard]] LaneMask<R> isLate(const Ends& ends, const HeightCubic<R>& height,
                                   const First& first) const;
  void keepSooner(const Ends& ends, const Lowest& lowest, const First& first,
                  Candidates& found) const;
  void solve(const Ends& ends, const LaneMask<R>& lanes, const Candidates& found,
             const typename LaneTraits<R>::Index& vertex, bool unlessLate, First& first) const;
  void look(const Ends& ends, Candidates& found, First& first) const;

  const BodyModel& body_;
  FlightPath<R> path_;
  R length_;
  mutable PathPoint<R> last_;
};

template <class R>
void FlightSegment<R>::measure(const Ends& ends, Candidates& found) const {
  const double* x = body_.rows.x.data() + found.begin;
  const double* y = body_.rows.y.data() + found.begin;
  const double* z = body_.rows.z.data() + found.begin;
  const Vec<R> up0 = ends.a.up, up1 = ends.b.up;
  for (std::size_t i = 0; i < found.count; ++i) {
    const R px(x[i]), py(y[i]), pz(z[i]);
    storeLanes(px * up0.x + py * up0.y + pz * up0.z, found.h0 + i * kLanes);
    storeLanes(px * up1.x + py * up1.y + pz * up1.z, found.h1 + i * kLanes);
  }
}

/// An end is so low that the vertex may touch on the way.
template <class R>
LaneMask<R> FlightSegment<R>::isLow(const Ends& ends, const Candidates& found,
                                    std::size_t i) const {
  const R h0 = loadLanes<R>(found.h0 + i * kLanes), h1 = loadLanes<R>(found.h1 + i * kLanes);
  return ends.near & !((h0 > ends.limit0) & (h1 > ends.limit1));
}

template <class R>
auto FlightSegment<R>::lowest(const Ends& ends, const Candidates& found) const -> Lowest {
  Lowest all{R(0.0), R(0.0), LaneMask<R>(false)};
  R least(1e300);
  for (std::size_t i = 0; i < found.count; ++i) {
    const LaneMask<R> low = isLow(ends, found, i);
    if (!anyLane(low)) continue;
    const R number(static_cast<double>(i)), end = ends.b.z + loadLanes<R>(found.h1 + i * kLanes);
    setWhere(low & !all.any, all.first, number);
    all.any = all.any | low;
    const LaneMask<R> lower = low & (end < least);
    setWhere(lower, least, end);
    setWhere(lower, all.vertex, number);
  }
  return all;
}

/// A vertex that is above the ground where the first touch is, and by more than the way there may
/// bend down, does not touch before.
template <class R>
LaneMask<R> FlightSegment<R>::isLate(const Ends& ends, const HeightCubic<R>& height,
                                     const First& first) const {
  return (first.share <= R(1.0)) &
         (laneMin(height.h0, height.at(first.share)) > ends.bend * first.share * first.share);
}

/// Lists what may touch sooner than the lowest does, in the order of the hull; but the first of all
/// that were low is in the place of the lowest.
template <class R>
void FlightSegment<R>::keepSooner(const Ends& ends, const Lowest& lowest, const First& first,
                                  Candidates& found) const {
  found.vertices.clear();
  LaneMask<R> firstOne(false);
  for (std::size_t i = 0; i < found.count; ++i) {
    const LaneMask<R> low = isLow(ends, found, i);
    if (!anyLane(low)) continue;
    const std::size_t k = found.begin + i;
    const Vec<R> p = {R(body_.rows.x[k]), R(body_.rows.y[k]), R(body_.rows.z[k])};
    const R h0 = ends.a.z + loadLanes<R>(found.h0 + i * kLanes);
    const R h1 = ends.b.z + loadLanes<R>(found.h1 + i * kLanes);
    const HeightCubic<R> height(h0, ends.a.rate(p), h1, ends.b.rate(p), length_);
    const LaneMask<R> sooner = low & !isLate(ends, height, first);
    const R number(static_cast<double>(i));
    const LaneMask<R> isFirst = lowest.first == number, isLowest = lowest.vertex == number;
    firstOne = firstOne | (sooner & isFirst & !isLowest);
    const LaneMask<R> swapped = low & isLowest & firstOne;
    if (anyLane(swapped)) found.vertices.addOwn(swapped, lowest.first);
    found.vertices.add(sooner & !(isFirst | isLowest), i);
  }
}

/// Solves for the first touch of a vertex of each lane, of `lanes`; with `unlessLate` where it is
/// not late.
template <class R>
void FlightSegment<R>::solve(const Ends& ends, const LaneMask<R>& lanes, const Candidates& found,
                             const typename LaneTraits<R>::Index& vertex, bool unlessLate,
                             First& first) const {
  const double* x = body_.rows.x.data() + found.begin;
  const double* y = body_.rows.y.data() + found.begin;
  const double* z = body_.rows.z.data() + found.begin;
  const Vec<R> p = {fromTable<R>(x, vertex), fromTable<R>(y, vertex), fromTable<R>(z, vertex)};
  const R h0 = ends.a.z + fromRows<R>(found.h0, vertex);
  const R h1 = ends.b.z + fromRows<R>(found.h1, vertex);
  const HeightCubic<R> height(h0, ends.a.rate(p), h1, ends.b.rate(p), length_);
  LaneMask<R> open = lanes;
  if (unlessLate) open = open & !isLate(ends, height, first);
  if (!anyLane(open)) return;
  const R s = height.firstTouch(open);
  const LaneMask<R> sooner = open & (s < first.share);
  setWhere(sooner, first.share, s);
  setWhere(sooner, first.place, p);
}

/// The vertex that ends lowest is likely to touch first, and spares looking at most of the others.
template <class R>
void FlightSegment<R>::look(const Ends& ends, Candidates& found, First& first) const {
  measure(ends, found);
  const Lowest low = lowest(ends, found);
  if (!anyLane(low.any)) return;
  solve(ends, low.any, found, indexOf(low.vertex), found.begin > 0, first);
  keepSooner(ends, low, first, found);
  for (int c = 0; c < found.vertices.count(); ++c) {
    solve(ends, found.vertices.lanesWith(c), found, found.vertices.at(c), true, first);
  }
}

template <class R>
R FlightSegment<R>::firstTouch() const {
  const R two(2.0), none = two * length_;
  const KernelState<R>& start = path_.start();
  const KernelState<R> end = at(length_);
  const LaneMask<R> near = !(laneMin(start.position.z, end.position.z) > R(body_.radius));
  if (!anyLane(near)) return none;
  const Heights a(start), b(end);
  const R bend = path_.bend(length_);
  const Ends ends{a, b, bend, bend - a.z, bend - b.z, near};
  First first{two, {}};
  Candidates found;
  for (std::size_t begin = 0; begin < body_.x.size(); begin += kChunk) {
    found.begin = begin;
    found.count = std::min(kChunk, body_.x.size() - begin);
    look(ends, found, first);
  }
  const LaneMask<R> touches = !(first.share > R(1.0));
  if (!anyLane(touches)) return none;
  PathPoint<R> seen{};
  const R touch = path_.refined(first.share * length_, first.place, length_, seen);
  setWhere(touches, last_.t, seen.t);
  setWhere(touches, last_.state, seen.state);
  return select(touches, touch, none);
}

/// Flies one segment, to the first touch or to its end; no further than to `limit` (s). Returns the
/// lanes that touch.
template <class R>
LaneMask<R> flyOn(const BodyModel& body, const R& limit, Simulation<R>& sim) {
  const R zero(0.0);
  const FlightSegment<R> segment(body, sim.state, limit - sim.state.time);
  const R hit = segment.firstTouch();
  const LaneMask<R> touches = !(hit > segment.length());
  sim.state = segment.at(select(touches, hit, segment.length()));
  sim.lastCount = sim.lastStep = zero;
  sim.quietSince = R(-1.0);
  const LaneMask<R> another = (hit > R(1e-6)) | !touches;
  setWhere(another, sim.impactsHere, zero);
  setWhere(another, sim.stuck, zero);
  return touches;
}

}  // namespace ifa

#endif
