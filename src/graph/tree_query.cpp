// SPDX-License-Identifier: Apache-2.0
#include "graph/tree_query.h"

#include <limits>

namespace ifa {

namespace {

using Eigen::Vector3d;

constexpr double kWidened = 1 + 1e-4;  // of limits, so that rounding refuses nothing

std::array<float, 3> rounded(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

RegionForm formOf(const Eigen::Matrix3d& axes) {
  const double along = 1 / axes.col(0).squaredNorm(), across = 1 / axes.col(1).squaredNorm();
  return {rounded(axes.col(0).normalized()), static_cast<float>(across),
          static_cast<float>(across - along)};
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
  mostWarp = exact ? std::numeric_limits<float>::infinity()
                   : real(p.timeWarp * settings.largestWarp * settings.largestWarp * kWidened);
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
  squaredSpeed = real(
      (before * (1 + settings.energyGain) - 2 * kGravity * source.after.position.z()) * kWidened +
      1e-5);
  moments = rounded(perMass);
}

}  // namespace ifa
