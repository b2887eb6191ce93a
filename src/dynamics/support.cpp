// SPDX-License-Identifier: Apache-2.0
#include "dynamics/support.h"

#include <algorithm>
#include <limits>

namespace ifa {

namespace {

/// The centre of mass must be inside by this share of the squared radius (twice an area).
constexpr double kMargin = 1e-3;

}  // namespace

void thinBySpread(std::size_t most, std::vector<LowSpot>& spots) {
  std::vector<double> far(spots.size(), std::numeric_limits<double>::max());
  std::size_t next = 0;
  for (std::size_t c = 0; c < spots.size(); ++c) {
    if (spots[c].gap < spots[next].gap) next = c;
  }
  std::vector<LowSpot> kept;
  while (kept.size() < most) {
    kept.push_back(spots[next]);
    for (std::size_t c = 0; c < spots.size(); ++c) {
      const double dx = spots[c].spot.x - spots[next].spot.x;
      const double dy = spots[c].spot.y - spots[next].spot.y;
      far[c] = std::min(far[c], dx * dx + dy * dy);
    }
    next = static_cast<std::size_t>(std::max_element(far.begin(), far.end()) - far.begin());
  }
  spots = kept;
}

/// Seen from the centre of mass, vertices lie on both sides of the line to every vertex.
bool isSupported(const std::vector<Spot>& spots, const BodyModel& body) {
  if (spots.size() < 3) return false;
  const double margin = kMargin * body.radius * body.radius;
  return std::all_of(spots.begin(), spots.end(), [&](const Spot& a) {
    double left = 0, right = 0;
    for (const Spot& b : spots) {
      const double side = a.x * b.y - a.y * b.x;
      left = std::max(left, side);
      right = std::min(right, side);
    }
    return left >= margin && right <= -margin;
  });
}

}  // namespace ifa
