// SPDX-License-Identifier: Apache-2.0
#include "dynamics/flight.h"

#include <algorithm>
#include <utility>

namespace ifa {

namespace {

/// A touch is found when the vertex is as near to the ground as this, m: the planner asks for its
/// time to 1e-7 s.
constexpr double kOnGround = 1e-11;

}  // namespace

KernelState<double> FlightSegment::computed(double t) const {
  const Spin<double> spin = rotation_.at(t);
  KernelState<double> s = start_;
  s.time += t;
  s.position = s.position + s.velocity * t;
  s.position.z -= 0.5 * kGravity * t * t;
  s.velocity.z -= kGravity * t;
  s.q = spin.q;
  s.w = spin.w;
  return s;
}

/// Seconds in which the body, whatever its turn, is too high to touch; 0 when it is not.
double FlightSegment::timeAbove() const {
  const double over = start_.position.z - 1.0001 * body_.radius, rise = start_.velocity.z;
  return over > 0 ? (rise + laneSqrt(rise * rise + 2 * kGravity * over)) / kGravity : 0;
}

/// Collects vertices whose lower end is under `dip`, from vertex `next` on, until kMostCandidates
/// are found.
std::size_t FlightSegment::findLow(const Heights& a, const Heights& b, double dip,
                                   std::size_t& next, Candidate* found) const {
  constexpr std::size_t kChunk = VertexRows::kChunk;
  const double *x = body_.rows.x.data(), *y = body_.rows.y.data(), *z = body_.rows.z.data();
  const double limit0 = dip - a.z, limit1 = dip - b.z;
  std::size_t count = 0;
  for (; next < body_.rows.size() && count + kChunk <= kMostCandidates; next += kChunk) {
    double h0[kChunk], h1[kChunk];
    for (std::size_t k = 0; k < kChunk; ++k) {
      const double px = x[next + k], py = y[next + k], pz = z[next + k];
      h0[k] = px * a.up.x + py * a.up.y + pz * a.up.z;
      h1[k] = px * b.up.x + py * b.up.y + pz * b.up.z;
    }
    for (std::size_t k = 0; k < kChunk; ++k) {
      if (h0[k] > limit0 && h1[k] > limit1) continue;
      found[count++] = {next + k, a.z + h0[k], b.z + h1[k]};
    }
  }
  return count;
}

double FlightSegment::firstTouch() const {
  const KernelState<double> end = at(length_);
  // A parabola is lowest at its ends; so is the sum of one and of what a vertex adds, but for the
  // bend of its circle: |up''| <= 2 w^2 within a segment.
  if (laneMin(start_.position.z, end.position.z) > body_.radius) return 2 * length_;
  const Heights a(start_), b(end);
  const double bend = 0.25 * length_ * length_ * body_.radius * spin2_;
  Candidate found[kMostCandidates];
  double first = 2;
  std::size_t lowest = 0;
  for (std::size_t next = 0; next < body_.rows.size();) {
    const std::size_t count = findLow(a, b, bend, next, found);
    if (count == 0) continue;
    // The one that ends lowest is likely to be the first, and spares looking at the others.
    std::swap(found[0], *std::min_element(found, found + count, [](const auto& c, const auto& d) {
                return c.h1 < d.h1;
              }));
    for (std::size_t c = 0; c < count; ++c) {
      const Vec<double> p = place(found[c].vertex);
      const HeightCubic<double> height(found[c].h0, a.rate(p), found[c].h1, b.rate(p), length_);
      if (first <= 1 && laneMin(found[c].h0, height.at(first)) > bend * first * first) continue;
      const double s = height.firstTouch();
      if (s < first) {
        first = s;
        lowest = found[c].vertex;
      }
    }
  }
  return first > 1 ? 2 * length_ : refined(first * length_, lowest);
}

/// Newton steps on the exact motion, from the touch of a cubic.
double FlightSegment::refined(double t, std::size_t vertex) const {
  const Vec<double> p = place(vertex);
  for (int i = 0; i < 3; ++i) {
    lastTime_ = t;
    last_ = computed(t);
    const Heights heights(last_);
    const double height = heights.height(p), rate = heights.rate(p);
    if (rate > -1e-4 || std::fabs(height) < kOnGround) break;
    const double next = t - height / rate;
    if (!(next > 0 && next < length_)) break;
    t = next;
  }
  return t;
}

}  // namespace ifa
