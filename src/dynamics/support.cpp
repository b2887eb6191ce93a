// SPDX-License-Identifier: Apache-2.0
#include "dynamics/support.h"

#include <algorithm>
#include <limits>

namespace ifa {

namespace {

/// The centre of mass must be inside by this share of the squared radius (twice an area).
constexpr double kMargin = 1e-3;

struct Spot {
  double x, y;
};

Spot spotOf(const GroundWatch& watch, std::size_t i, const Rotation<double>& rotation) {
  const Vec<double> p = watch.place(i);
  return {dot(rotation.rows[0], p), dot(rotation.rows[1], p)};
}

}  // namespace

void thinBySpread(const GroundWatch& watch, const GroundFrame& frame,
                  const Rotation<double>& rotation, std::size_t most,
                  std::vector<std::size_t>& chosen) {
  std::vector<Spot> spots(chosen.size());
  std::vector<double> far(chosen.size(), std::numeric_limits<double>::max());
  std::size_t next = 0;
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    spots[c] = spotOf(watch, chosen[c], rotation);
    if (frame.gap[chosen[c]] < frame.gap[chosen[next]]) next = c;
  }
  std::vector<std::size_t> kept;
  while (kept.size() < most) {
    kept.push_back(chosen[next]);
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      const double dx = spots[c].x - spots[next].x, dy = spots[c].y - spots[next].y;
      far[c] = std::min(far[c], dx * dx + dy * dy);
    }
    next = static_cast<std::size_t>(std::max_element(far.begin(), far.end()) - far.begin());
  }
  chosen = kept;
}

/// Seen from the centre of mass, vertices lie on both sides of the line to every vertex.
bool isSupported(const GroundWatch& watch, const GroundFrame& frame,
                 const Rotation<double>& rotation, const BodyModel& body) {
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < watch.count(); ++i) {
    if (frame.gap[i] <= body.slop) spots.push_back(spotOf(watch, i, rotation));
  }
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
