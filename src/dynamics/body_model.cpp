// SPDX-License-Identifier: Apache-2.0
#include "dynamics/body_model.h"

#include <algorithm>
#include <cmath>

namespace ifa {

namespace {

/// A body rocks and rolls at a rate that falls with the root of its size, and with it goes the step
/// that follows it; impacts take no step.
constexpr double kDieRadius = 0.015, kMostSteps = 2;  // m, times

}  // namespace

void VertexRows::add(double px, double py, double pz) {
  x.push_back(px);
  y.push_back(py);
  z.push_back(pz);
}

void VertexRows::fillUp() {
  while (size() % kChunk != 0) add(x.back(), y.back(), z.back());
}

BodyModel::BodyModel(const Body& body, const SurfaceProperties& surfaceIn,
                     const KernelSettings& kernel)
    : mass(body.mass), inverseMass(1 / body.mass), surface(surfaceIn), settings(kernel) {
  radius = 0;
  for (const Eigen::Vector3d& vertex : body.hull) {
    const Eigen::Vector3d p = body.bodyFromPrincipal.transpose() * vertex;
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
    radius = std::max(radius, p.norm());
    rows.add(p.x(), p.y(), p.z());
  }
  rows.fillUp();
  Eigen::Vector3d moments = body.principalMoments;
  const double alike = 1e-6 * moments.maxCoeff();
  isotropic = moments[2] - moments[0] < alike;
  if (isotropic) {
    moments.setConstant(moments.mean());
  } else if (moments[1] - moments[0] < alike) {
    symmetryAxis = 2;
    moments.head<2>().setConstant(moments.head<2>().mean());
  } else if (moments[2] - moments[1] < alike) {
    symmetryAxis = 0;
    moments.tail<2>().setConstant(moments.tail<2>().mean());
  }
  inertia = {moments.x(), moments.y(), moments.z()};
  inverseInertia = {1 / inertia.x, 1 / inertia.y, 1 / inertia.z};
  euler = {(inertia.y - inertia.z) / inertia.x, (inertia.z - inertia.x) / inertia.y,
           (inertia.x - inertia.y) / inertia.z};
  step = settings.step * std::clamp(std::sqrt(radius / kDieRadius), 1.0, kMostSteps);
  slop = std::max(1e-5, 1e-3 * radius);
  hitGap = 0.3 * slop;
  speedRoot = std::sqrt(inverseMass + radius * radius / moments.minCoeff());
}

}  // namespace ifa
