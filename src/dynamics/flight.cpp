// SPDX-License-Identifier: Apache-2.0
#include "dynamics/flight.h"

#include <algorithm>
#include <utility>

#include "dynamics/height_cubic.h"

namespace ifa {

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
  if (laneMin(path_.start().position.z, end.position.z) > body_.radius) return 2 * length_;
  const Heights a(path_.start()), b(end);
  const double bend = path_.bend(length_);
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
  return first > 1 ? 2 * length_ : path_.refined(first * length_, place(lowest), length_, last_);
}

}  // namespace ifa
