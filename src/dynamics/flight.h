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

  /// Vertices of a chunk that come near the ground, each lane's own, and heights of all at the
  /// segment's ends. The vertex that ends lowest is the first: it is likely to touch first, and
  /// spares looking at the others.
  struct Candidates {
    ChosenVertices<R, kChunk> vertices;
    alignas(kLanes * sizeof(double)) double h0[kChunk * kLanes], h1[kChunk * kLanes];
  };
  /// The first touch so far: share of the segment, 2 for none, and the vertex.
  struct First {
    R share;
    Vec<R> place;
  };

  void measure(const Heights& a, const Heights& b, std::size_t begin, std::size_t count,
               Candidates& found) const;
  void findLow(const LaneMask<R>& near, const R& z0, const R& z1, const R& dip, std::size_t count,
               Candidates& found) const;
  void look(const Heights& a, const Heights& b, const R& bend, std::size_t begin,
            const Candidates& found, First& first) const;

  const BodyModel& body_;
  FlightPath<R> path_;
  R length_;
  mutable PathPoint<R> last_;
};

/// Heights over the centre of `count` vertices from number `begin` on.
template <class R>
void FlightSegment<R>::measure(const Heights& a, const Heights& b, std::size_t begin,
                               std::size_t count, Candidates& found) const {
  const double* x = body_.rows.x.data() + begin;
  const double* y = body_.rows.y.data() + begin;
  const double* z = body_.rows.z.data() + begin;
  const Vec<R> up0 = a.up, up1 = b.up;
  for (std::size_t i = 0; i < count; ++i) {
    const R px(x[i]), py(y[i]), pz(z[i]);
    storeLanes(px * up0.x + py * up0.y + pz * up0.z, found.h0 + i * kLanes);
    storeLanes(px * up1.x + py * up1.y + pz * up1.z, found.h1 + i * kLanes);
  }
}

/// Those of which an end is under `dip`, in the lanes `near`. `z0`, `z1`: height of the centre.
template <class R>
void FlightSegment<R>::findLow(const LaneMask<R>& near, const R& z0, const R& z1, const R& dip,
                               std::size_t count, Candidates& found) const {
  const R limit0 = dip - z0, limit1 = dip - z1;
  R least(1e300), place(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const R h0 = loadLanes<R>(found.h0 + i * kLanes), h1 = loadLanes<R>(found.h1 + i * kLanes);
    const LaneMask<R> low = near & !((h0 > limit0) & (h1 > limit1));
    if (!anyLane(low)) continue;
    const R end = z1 + h1;
    const LaneMask<R> lowest = low & (end < least);
    setWhere(lowest, least, end);
    setWhere(lowest, place, found.vertices.counts());
    found.vertices.add(low, i);
  }
  alignas(kLanes * sizeof(double)) double places[kLanes];
  storeLanes(place, places);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    std::swap(found.vertices.number(0, lane),
              found.vertices.number(static_cast<std::size_t>(places[lane]), lane));
  }
}

template <class R>
void FlightSegment<R>::look(const Heights& a, const Heights& b, const R& bend, std::size_t begin,
                            const Candidates& found, First& first) const {
  const R one(1.0);
  for (int c = 0; c < found.vertices.count(); ++c) {
    const auto i = found.vertices.at(c);
    const R h0 = a.z + fromRows<R>(found.h0, i), h1 = b.z + fromRows<R>(found.h1, i);
    const Vec<R> p = {fromTable<R>(body_.rows.x.data() + begin, i),
                      fromTable<R>(body_.rows.y.data() + begin, i),
                      fromTable<R>(body_.rows.z.data() + begin, i)};
    const HeightCubic<R> height(h0, a.rate(p), h1, b.rate(p), length_);
    const LaneMask<R> late = (first.share <= one) & (laneMin(h0, height.at(first.share)) >
                                                     bend * first.share * first.share);
    const LaneMask<R> open = found.vertices.lanesWith(c) & !late;
    if (!anyLane(open)) continue;
    const R s = height.firstTouch();
    const LaneMask<R> sooner = open & (s < first.share);
    setWhere(sooner, first.share, s);
    setWhere(sooner, first.place, p);
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
  First first{two, {}};
  Candidates found;
  for (std::size_t begin = 0; begin < body_.x.size(); begin += kChunk) {
    const std::size_t count = std::min(kChunk, body_.x.size() - begin);
    found.vertices.clear();
    measure(a, b, begin, count, found);
    findLow(near, a.z, b.z, bend, count, found);
    look(a, b, bend, begin, found, first);
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
