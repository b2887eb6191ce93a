// SPDX-License-Identifier: Apache-2.0
#include "affinity/factors.h"

#include <algorithm>
#include <cmath>

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Orthogonal axes, the first along `direction`; columns scaled by `along` and `across`.
Matrix3d scaledAxes(const Vector3d& direction, double along, double across) {
  const double length = direction.norm();
  const Vector3d first = length > 0 ? Vector3d(direction / length) : Vector3d(Vector3d::UnitZ());
  const Vector3d helper = std::abs(first.x()) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d second = first.cross(helper).normalized();
  Matrix3d axes;
  axes << along * first, across * second, across * first.cross(second);
  return axes;
}

double squared(double x) { return x * x; }

bool discrete(const HeardEvent& event) { return event.duration <= 0; }

}  // namespace

PlausibleRegion::PlausibleRegion(const Vector3d& linear, const Vector3d& angular, double radius,
                                 const AffinityParameters& p) {
  const double v = std::max(linear.norm(), p.smallestChange);
  const double w = std::max(angular.norm(), p.smallestChange / radius);
  const double a = p.maxRelativeLinear * v, c = p.maxRelativeAngular * w;
  linearAxes_ = scaledAxes(linear, a, a * p.tanLinear);
  angularAxes_ = scaledAxes(angular, c, c * p.tanAngular);
}

void PlausibleRegion::change(const Eigen::Matrix<double, 6, 1>& y, Vector3d& linear,
                             Vector3d& angular) const {
  linear = linearAxes_ * y.head<3>();
  angular = angularAxes_ * y.tail<3>();
}

Eigen::Matrix<double, 6, 1> PlausibleRegion::coordinates(const Vector3d& linear,
                                                         const Vector3d& angular) const {
  Eigen::Matrix<double, 6, 1> y;
  for (int i = 0; i < 3; ++i) {
    y[i] = linearAxes_.col(i).dot(linear) / linearAxes_.col(i).squaredNorm();
    y[3 + i] = angularAxes_.col(i).dot(angular) / angularAxes_.col(i).squaredNorm();
  }
  return y;
}

double logOrientation(double angle, double time, const AffinityParameters& p) {
  return -p.orientation * squared(angle / std::min(time, p.orientationTime));
}

double logTimeWarp(double target, double blended, const AffinityParameters& p) {
  return -p.timeWarp * squared(std::max(target, blended) / std::min(target, blended) - 1);
}

double logAmplitude(const HeardEvent& target, const HeardEvent& event,
                    const AffinityParameters& p) {
  return -p.amplitude * squared(target.amplitude - event.amplitude);
}

double logDuration(const HeardEvent& target, const HeardEvent& event, const AffinityParameters& p) {
  if (discrete(target) && discrete(event)) return 0;
  return -p.duration * squared(target.duration - event.duration);
}

double logCentroid(const HeardEvent& target, const HeardEvent& event, const AffinityParameters& p) {
  if (discrete(target) && discrete(event)) return 0;
  const double a = discrete(target) ? 0 : target.centroid;
  const double b = discrete(event) ? 0 : event.centroid;
  return -p.duration * squared(a - b);
}

double LogScore::score(int n) const { return std::exp(total() / (6 * n)); }
double LogScore::scoreWithoutSound(int n) const { return std::exp(motion / (3 * n)); }
double LogScore::meanVelocity(int n) const { return std::exp(velocity / n); }

}  // namespace ifa
