// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/tree_query.h"

namespace ifa {

namespace {

// The loops run over whole rows of floats, and without fused operations their bits are the same in
// any width, so each processor may have its widest.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define IFA_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define IFA_WIDEST
#endif
#define IFA_INLINE __attribute__((always_inline)) inline

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kGravityF = static_cast<float>(kGravity);

struct Triple {
  float x, y, z;
};

IFA_INLINE float dot(Triple a, Triple b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

IFA_INLINE Triple cross(Triple a, Triple b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

IFA_INLINE Triple triple(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

/// The smallest turn from one unit vector to another.
struct ShortTurn {
  Triple sine;
  float cosine, scale;

  IFA_INLINE ShortTurn(Triple from, Triple to) : sine(cross(from, to)), cosine(dot(from, to)) {
    scale = 1 / std::max(1 + cosine, 1e-6F);
  }
  IFA_INLINE Triple operator*(Triple v) const {
    const Triple c = cross(sine, v);
    const float s = dot(sine, v) * scale;
    return {cosine * v.x + c.x + sine.x * s, cosine * v.y + c.y + sine.y * s,
            cosine * v.z + c.z + sine.z * s};
  }
};

/// Square of the angle between unit vectors this chord apart, by series of the arc sine.
IFA_INLINE float squaredAngle(float chord2) {
  return chord2 * (1 + chord2 * (1.0F / 12 + chord2 * (1.0F / 90 + chord2 * (1.0F / 560))));
}

IFA_INLINE float formAt(const RegionForm& form, Triple v) {
  const float along = dot(triple(form.axis), v);
  return form.across * dot(v, v) - form.difference * along * along;
}

IFA_INLINE float squared(float x) { return x * x; }

IFA_INLINE float clamped(float x, float low, float high) {
  return std::min(std::max(x, low), high);
}

/// Range of a vector.
struct Box {
  Triple low, high;
};

/// Least value of the form with its axis turned to `axis` over v in a box: sweeps over the
/// coordinates, from the place nearest to 0.
IFA_INLINE float leastInBox(const RegionForm& form, Triple axis, const Box& box) {
  Triple v = {clamped(0, box.low.x, box.high.x), clamped(0, box.low.y, box.high.y),
              clamped(0, box.low.z, box.high.z)};
  const float d = form.difference;
  const float ix = d / (form.across - d * axis.x * axis.x) * axis.x;
  const float iy = d / (form.across - d * axis.y * axis.y) * axis.y;
  const float iz = d / (form.across - d * axis.z * axis.z) * axis.z;
  for (int sweep = 0; sweep < 2; ++sweep) {
    v.x = clamped(ix * (axis.y * v.y + axis.z * v.z), box.low.x, box.high.x);
    v.y = clamped(iy * (axis.x * v.x + axis.z * v.z), box.low.y, box.high.y);
    v.z = clamped(iz * (axis.x * v.x + axis.y * v.y), box.low.z, box.high.z);
  }
  const float along = dot(axis, v);
  return form.across * dot(v, v) - d * along * along;
}

/// -log f_t.
IFA_INLINE float warpCost(float own, const TreeQuery& q) {
  const float ratio = own / q.time;
  return q.timeWarp * squared(std::max(ratio, 1 / ratio) - 1);
}

/// -log f_a f_l f_c.
IFA_INLINE float soundCost(float loud, float duration, float centroid, const TreeQuery& q) {
  return q.loudness * squared(loud - q.loud) +
         q.sound * (squared(duration - q.duration) + squared(centroid - q.centroid));
}

/// -log f_q. @param turn2  square of the angle
IFA_INLINE float orientationCost(float turn2, float time, const TreeQuery& q) {
  return q.orientation * turn2 / squared(std::min(time, q.longTime));
}

IFA_INLINE float chord2(Triple a, Triple b) {
  return squared(a.x - b.x) + squared(a.y - b.y) + squared(a.z - b.z);
}

IFA_INLINE Triple column3(const float* e, std::size_t column) {
  constexpr std::size_t n = kLeafEvents;
  return {e[column * n], e[(column + 1) * n], e[(column + 2) * n]};
}

IFA_INLINE float weighEvent(const float* e, const TreeQuery& q) {
  constexpr std::size_t n = kLeafEvents;
  const Triple up = column3(e, kUpX), onto = triple(q.up), own = column3(e, kSpinX);
  const ShortTurn turn(up, onto);
  const float gap = e[kTime * n], time = q.fixedTime + q.ownTime * gap, rate = 1 / time;
  const Triple flight = turn * column3(e, kFlightX), spin = turn * own;
  // v_blend = stretch flight + lift up; v_{j+} = flight + fall up
  const float stretch = gap * rate;
  const float lift = (e[kHeight * n] - q.height) * rate + 0.5F * kGravityF * time;
  const Triple leaving = {stretch * flight.x + lift * onto.x, stretch * flight.y + lift * onto.y,
                          stretch * flight.z + lift * onto.z};
  const float keep = q.keepOwn, fall = 0.5F * kGravityF * gap * keep;
  const Triple bent = {leaving.x - q.keepSource * q.velocity[0] - keep * flight.x - fall * onto.x,
                       leaving.y - q.keepSource * q.velocity[1] - keep * flight.y - fall * onto.y,
                       leaving.z - q.keepSource * q.velocity[2] - keep * flight.z - fall * onto.z};
  const Triple spun = {q.spin[0] - spin.x, q.spin[1] - spin.y, q.spin[2] - spin.z};
  const float velocity = formAt(q.linear, bent) + formAt(q.angular, spun);
  const float orientation = orientationCost(squaredAngle(chord2(up, onto)), time, q);
  const float warp = warpCost(gap, q);
  const float sum = velocity + orientation + warp +
                    soundCost(e[kHeardLoud * n], e[kHeardDuration * n], e[kHeardCentroid * n], q);
  const float speed2 = dot(leaving, leaving) + q.moments[0] * own.x * own.x +
                       q.moments[1] * own.y * own.y + q.moments[2] * own.z * own.z;
  // Rising at k, and less than that as simulated.
  const float rising =
      std::min(dot(leaving, onto) - kGravityF * time, 0.5F * kGravityF * gap - dot(flight, onto));
  const bool there = (velocity <= q.leastVelocity) & (orientation <= q.leastOrientation) &
                     (speed2 <= q.squaredSpeed) & (rising <= 1e-3F) & (warp <= q.mostWarp);
  return there ? -sum : -kInfinity;
}

/// A child's range of the vector in three columns, less `less`, widened by `play`.
IFA_INLINE Box rangeOf(const TreeNode& b, std::size_t i, std::size_t column, Triple less,
                       float play) {
  return {{b.low[column][i] - less.x - play, b.low[column + 1][i] - less.y - play,
           b.low[column + 2][i] - less.z - play},
          {b.high[column][i] - less.x + play, b.high[column + 1][i] - less.y + play,
           b.high[column + 2][i] - less.z + play}};
}

IFA_INLINE float nearestIn(const TreeNode& b, std::size_t i, std::size_t column, float x) {
  return clamped(x, b.low[column][i], b.high[column][i]);
}

/// Least cost of the angular part. The turn that lays j over i is that of the place in the box
/// nearest to the query; how far the spin may turn between places of the box is added to its range.
IFA_INLINE float angularCost(const TreeNode& b, std::size_t i, const TreeQuery& q,
                             const ShortTurn& turn) {
  const Triple low = {b.low[kUpX][i], b.low[kUpY][i], b.low[kUpZ][i]};
  const Triple high = {b.high[kUpX][i], b.high[kUpY][i], b.high[kUpZ][i]};
  const float reach = std::min(0.5F * std::sqrt(chord2(low, high)), 0.5F);
  const Triple spin = turn * triple(q.spin);
  const float play = reach * std::sqrt(dot(spin, spin));
  return leastInBox(q.angular, turn * triple(q.angular.axis), rangeOf(b, i, kSpinX, spin, play));
}

/// Likewise of the linear part. The turn matters less here: velocities are bent by more.
IFA_INLINE float linearCost(const TreeNode& b, std::size_t i, const TreeQuery& q,
                            const ShortTurn& turn, float time, float own) {
  const Triple onto = triple(q.up);
  const float half = 0.5F * (b.high[kHeight][i] - b.low[kHeight][i]);
  const float lower = b.low[kHeight][i] + half - q.height;
  const float squeeze = time / own, lift = lower / time + 0.5F * kGravityF * time;
  const Triple ask = turn * Triple{q.velocity[0] - lift * onto.x, q.velocity[1] - lift * onto.y,
                                   q.velocity[2] - lift * onto.z};
  const Triple mean = {ask.x * squeeze, ask.y * squeeze, ask.z * squeeze};
  // Other heights in the box, and other times where the flight lasts T_j, lift otherwise.
  const float least = q.fixedTime + q.ownTime * b.low[kTime][i];
  const float most = q.fixedTime + q.ownTime * b.high[kTime][i];
  const float play =
      half / least + std::abs(lower) * (1 / least - 1 / time) + 0.5F * kGravityF * (most - least);
  return q.keepSource / squared(squeeze) *
         leastInBox(q.linear, turn * triple(q.linear.axis),
                    rangeOf(b, i, kFlightX, mean, play * squeeze));
}

IFA_INLINE float weighBox(const TreeNode& b, std::size_t i, const TreeQuery& q) {
  const Triple onto = triple(q.up);
  const Triple near = {nearestIn(b, i, kUpX, onto.x), nearestIn(b, i, kUpY, onto.y),
                       nearestIn(b, i, kUpZ, onto.z)};
  const float unit = 1 / std::sqrt(dot(near, near) + 1e-12F);
  const ShortTurn turn(onto, {near.x * unit, near.y * unit, near.z * unit});
  const float own = nearestIn(b, i, kTime, q.time), time = q.fixedTime + q.ownTime * own;
  const float velocity = angularCost(b, i, q, turn) + linearCost(b, i, q, turn, time, own);
  const float longest = q.fixedTime + q.ownTime * b.high[kTime][i];
  const float orientation = orientationCost(chord2(near, onto), longest, q);
  const float warp = warpCost(own, q);
  const float sum =
      velocity + orientation + warp +
      soundCost(nearestIn(b, i, kHeardLoud, q.loud), nearestIn(b, i, kHeardDuration, q.duration),
                nearestIn(b, i, kHeardCentroid, q.centroid), q);
  const bool there =
      (velocity <= q.leastVelocity) & (orientation <= q.leastOrientation) & (warp <= q.mostWarp);
  return there ? -sum : -kInfinity;
}

}  // namespace

IFA_WIDEST void weighLeaf(const float* leaf, const TreeQuery& query, float* weights) {
  for (std::size_t i = 0; i < kLeafEvents; ++i) weights[i] = weighEvent(leaf + i, query);
}

IFA_WIDEST void weighBoxes(const TreeNode& node, const TreeQuery& query, float* weights) {
  for (std::size_t i = 0; i < kFanOut; ++i) weights[i] = weighBox(node, i, query);
}

}  // namespace ifa
