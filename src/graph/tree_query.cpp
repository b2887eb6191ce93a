// SPDX-License-Identifier: Apache-2.0
#include "graph/tree_query.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifa {

namespace {

using Eigen::Vector3d;

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
constexpr double kWidened = 1 + 1e-4;  // of limits, so that rounding refuses nothing

std::array<float, 3> rounded(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

RegionForm formOf(const Eigen::Matrix3d& axes) {
  const double along = 1 / axes.col(0).squaredNorm(), across = 1 / axes.col(1).squaredNorm();
  return {rounded(axes.col(0).normalized()), static_cast<float>(across),
          static_cast<float>(across - along)};
}

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

/// Least value of the form with its axis turned to `axis` over v in a box: three sweeps over the
/// coordinates.
IFA_INLINE float leastInBox(const RegionForm& form, Triple axis, Triple low, Triple high) {
  Triple v = {clamped(0, low.x, high.x), clamped(0, low.y, high.y), clamped(0, low.z, high.z)};
  const float d = form.difference;
  const float ix = d / (form.across - d * axis.x * axis.x) * axis.x;
  const float iy = d / (form.across - d * axis.y * axis.y) * axis.y;
  const float iz = d / (form.across - d * axis.z * axis.z) * axis.z;
  for (int sweep = 0; sweep < 2; ++sweep) {
    v.x = clamped(ix * (axis.y * v.y + axis.z * v.z), low.x, high.x);
    v.y = clamped(iy * (axis.x * v.x + axis.z * v.z), low.y, high.y);
    v.z = clamped(iz * (axis.x * v.x + axis.y * v.y), low.z, high.z);
  }
  const float along = dot(axis, v);
  return form.across * dot(v, v) - d * along * along;
}

IFA_INLINE float weighEvent(const float* e, const TreeQuery& q) {
  constexpr std::size_t n = kLeafEvents;
  const Triple up = {e[kUpX * n], e[kUpY * n], e[kUpZ * n]}, onto = triple(q.up);
  const ShortTurn turn(up, onto);
  const float own = e[kTime * n], time = q.fixedTime + q.ownTime * own, rate = 1 / time;
  const Triple mean = {e[kFlightX * n], e[kFlightY * n], e[kFlightZ * n]};
  const Triple flight = turn * mean;
  const Triple spin = turn * Triple{e[kSpinX * n], e[kSpinY * n], e[kSpinZ * n]};
  const float lower = e[kHeight * n] - q.height, half = 0.5F * kGravityF;
  // v_blend = stretch flight + lift up
  const float stretch = own * rate, lift = lower * rate + half * time;
  const Triple leaving = {stretch * flight.x + lift * onto.x, stretch * flight.y + lift * onto.y,
                          stretch * flight.z + lift * onto.z};
  const float fall = half * own * q.keepOwn;
  const Triple bent = {leaving.x - q.keepSource * q.velocity[0] - q.keepOwn * flight.x - fall * onto.x,
                       leaving.y - q.keepSource * q.velocity[1] - q.keepOwn * flight.y - fall * onto.y,
                       leaving.z - q.keepSource * q.velocity[2] - q.keepOwn * flight.z - fall * onto.z};
  const Triple spun = {q.spin[0] - spin.x, q.spin[1] - spin.y, q.spin[2] - spin.z};
  const float velocity = formAt(q.linear, bent) + formAt(q.angular, spun);
  const float chord2 =
      squared(up.x - onto.x) + squared(up.y - onto.y) + squared(up.z - onto.z);
  const float shortTime = std::min(time, q.longTime);
  const float orientation = q.orientation * squaredAngle(chord2) / (shortTime * shortTime);
  const float ratio = own / q.time, warp = std::max(ratio, 1 / ratio) - 1;
  const float sum = velocity + orientation + q.timeWarp * warp * warp +
                    q.loudness * squared(e[kHeardLoud * n] - q.loud) +
                    q.sound * (squared(e[kHeardDuration * n] - q.duration) +
                               squared(e[kHeardCentroid * n] - q.centroid));
  const float speed2 = dot(leaving, leaving) + q.moments[0] * squared(e[kSpinX * n]) +
                       q.moments[1] * squared(e[kSpinY * n]) + q.moments[2] * squared(e[kSpinZ * n]);
  const float rising = dot(leaving, onto) - kGravityF * time;
  const bool there = (velocity <= q.leastVelocity) & (orientation <= q.leastOrientation) &
                     (speed2 <= q.squaredSpeed) & (rising <= 1e-4F);
  return there ? -sum : -kInfinity;
}

IFA_INLINE float weighBox(const TreeNode& b, std::size_t i, const TreeQuery& q) {
  const Triple onto = triple(q.up);
  Triple near = {clamped(onto.x, b.low[kUpX][i], b.high[kUpX][i]),
                 clamped(onto.y, b.low[kUpY][i], b.high[kUpY][i]),
                 clamped(onto.z, b.low[kUpZ][i], b.high[kUpZ][i])};
  const float chord2 =
      squared(near.x - onto.x) + squared(near.y - onto.y) + squared(near.z - onto.z);
  const float unit = 1 / std::sqrt(dot(near, near) + 1e-12F);
  near = {near.x * unit, near.y * unit, near.z * unit};
  const ShortTurn turn(onto, near);
  const float own = clamped(q.time, b.low[kTime][i], b.high[kTime][i]);
  const float time = q.fixedTime + q.ownTime * own, squeeze = time / own;
  const float shortTime = std::min(time, q.longTime);
  const float orientation = q.orientation * chord2 / (shortTime * shortTime);
  const Triple spin = turn * triple(q.spin);
  const float angular = leastInBox(
      q.angular, turn * triple(q.angular.axis),
      {b.low[kSpinX][i] - spin.x, b.low[kSpinY][i] - spin.y, b.low[kSpinZ][i] - spin.z},
      {b.high[kSpinX][i] - spin.x, b.high[kSpinY][i] - spin.y, b.high[kSpinZ][i] - spin.z});
  const float fall = 0.5F * kGravityF * time;
  const Triple ask = turn * Triple{q.velocity[0] - fall * onto.x, q.velocity[1] - fall * onto.y,
                                   q.velocity[2] - fall * onto.z};
  const Triple mean = {ask.x * squeeze, ask.y * squeeze, ask.z * squeeze};
  const float linear =
      leastInBox(q.linear, turn * triple(q.linear.axis),
                 {b.low[kFlightX][i] - mean.x, b.low[kFlightY][i] - mean.y,
                  b.low[kFlightZ][i] - mean.z},
                 {b.high[kFlightX][i] - mean.x, b.high[kFlightY][i] - mean.y,
                  b.high[kFlightZ][i] - mean.z}) *
      q.keepSource / (squeeze * squeeze);
  const float ratio = own / q.time, warp = std::max(ratio, 1 / ratio) - 1;
  const float loud = clamped(q.loud, b.low[kHeardLoud][i], b.high[kHeardLoud][i]) - q.loud;
  const float duration =
      clamped(q.duration, b.low[kHeardDuration][i], b.high[kHeardDuration][i]) - q.duration;
  const float centroid =
      clamped(q.centroid, b.low[kHeardCentroid][i], b.high[kHeardCentroid][i]) - q.centroid;
  const float sum = linear + angular + orientation + q.timeWarp * warp * warp +
                    q.loudness * loud * loud +
                    q.sound * (duration * duration + centroid * centroid);
  const bool there =
      (linear + angular <= q.leastVelocity) & (orientation <= q.leastOrientation);
  return there ? -sum : -kInfinity;
}

}  // namespace

TreeQuery::TreeQuery(const Body& body, const GraphSettings& settings,
                     const TransitionSource& source, const TransitionTarget& target) {
  const auto real = [](double x) { return static_cast<float>(x); };
  const Eigen::Quaterniond inverse = source.after.orientation.conjugate();
  const AffinityParameters& p = settings.affinity;
  up = rounded(inverse * Vector3d::UnitZ());
  velocity = rounded(inverse * source.after.velocity);
  spin = rounded(inverse * source.after.angularVelocity);
  const PlausibleRegion region(
      inverse * (source.after.velocity - source.before.velocity),
      inverse * (source.after.angularVelocity - source.before.angularVelocity), body.radius, p);
  linear = formOf(region.linearAxes());
  angular = formOf(region.angularAxes());
  height = real(source.after.position.z());
  time = real(target.time);
  const bool exact = settings.connection == ConnectionKind::kExact;
  fixedTime = exact ? time : 0;
  ownTime = exact ? 0 : 1;
  const bool printed = settings.velocityReference == VelocityReference::kPrinted;
  keepSource = printed ? 0 : 1;
  keepOwn = printed ? 1 : 0;
  orientation = real(p.orientation);
  longTime = real(p.orientationTime);
  timeWarp = real(p.timeWarp);
  loud = real(target.heard.amplitude * target.firstAmplitude);
  loudness = real(p.amplitude / (target.firstAmplitude * target.firstAmplitude));
  duration = real(target.heard.duration);
  centroid = target.heard.duration > 0 ? real(target.heard.centroid) : 0;
  sound = real(p.duration);
  leastVelocity = real(-settings.leastVelocity * kWidened + 1e-3);
  leastOrientation = real(-settings.leastOrientation * kWidened + 1e-3);
  const Vector3d w = source.before.orientation.conjugate() * source.before.angularVelocity;
  const Vector3d perMass = body.principalMoments / body.mass;
  const double before = source.before.velocity.squaredNorm() + w.dot(perMass.cwiseProduct(w)) +
                        2 * kGravity * source.before.position.z();
  squaredSpeed = real((before * (1 + settings.energyGain) -
                       2 * kGravity * source.after.position.z()) *
                          kWidened +
                      1e-5);
  moments = rounded(perMass);
}

IFA_WIDEST void weighLeaf(const float* leaf, const TreeQuery& query, float* weights) {
  for (std::size_t i = 0; i < kLeafEvents; ++i) weights[i] = weighEvent(leaf + i, query);
}

IFA_WIDEST void weighBoxes(const TreeNode& node, const TreeQuery& query, float* weights) {
  for (std::size_t i = 0; i < kFanOut; ++i) weights[i] = weighBox(node, i, query);
}

}  // namespace ifa
