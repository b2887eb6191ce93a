// SPDX-License-Identifier: Apache-2.0
// Ballistic flight, exact, with the first vertex that touches the ground.
#ifndef IFA_DYNAMICS_FLIGHT_H
#define IFA_DYNAMICS_FLIGHT_H

#include <type_traits>

#include "dynamics/body_model.h"
#include "dynamics/flight_path.h"
#include "dynamics/simulation.h"
#include "dynamics/touch_search.h"

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
  const BodyModel& body_;
  FlightPath<R> path_;
  R length_;
  mutable PathPoint<R> last_;
};

template <class R>
R FlightSegment<R>::firstTouch() const {
  const R two(2.0), none = two * length_;
  const KernelState<R>& start = path_.start();
  const KernelState<R> end = at(length_);
  const LaneMask<R> near = !(laneMin(start.position.z, end.position.z) > R(body_.radius));
  if (!anyLane(near)) return none;
  const PointHeights<R> a(start), b(end);
  const TouchSearch<R> search(body_, a, b, path_.bend(length_), length_, near);
  const LaneMask<R> touches = !(search.share() > R(1.0));
  if (!anyLane(touches)) return none;
  PathPoint<R> seen{};
  const R touch = path_.refined(search.share() * length_, search.place(), length_, seen);
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
