// SPDX-License-Identifier: Apache-2.0
// Ballistic flight, exact, with the first vertex that touches the ground.
#pragma once

#include "dynamics/body_model.h"
#include "dynamics/flight_path.h"

namespace ifa {

/// One segment of a flight, with its first touch. Not to be shared between threads: it remembers
/// the state that was asked for last.
class FlightSegment {
 public:
  FlightSegment(const BodyModel& body, const KernelState<double>& start, double longest)
      : body_(body), path_(body, start), length_(path_.length(longest)) {
    last_ = {length_, path_.at(length_)};
  }

  [[nodiscard]] double length() const { return length_; }

  /// State `t` seconds after the segment's start.
  [[nodiscard]] KernelState<double> at(double t) const {
    return t == last_.t ? last_.state : path_.at(t);
  }

  /// Seconds from the start to the first touch; larger than length() when nothing touches.
  [[nodiscard]] double firstTouch() const;

 private:
  using Heights = PointHeights<double>;

  /// A vertex that comes near the ground, and its heights at the segment's ends.
  struct Candidate {
    std::size_t vertex;
    double h0, h1;
  };
  static constexpr std::size_t kMostCandidates = 128;

  std::size_t findLow(const Heights& a, const Heights& b, double dip, std::size_t& next,
                      Candidate* found) const;
  [[nodiscard]] Vec<double> place(std::size_t i) const {
    return {body_.rows.x[i], body_.rows.y[i], body_.rows.z[i]};
  }

  const BodyModel& body_;
  FlightPath<double> path_;
  double length_;
  mutable PathPoint<double> last_;
};

}  // namespace ifa
