// SPDX-License-Identifier: Apache-2.0
#include "connection/registration.h"

#include <cmath>

#include "base/portable_math.h"

namespace ifa {

namespace {

constexpr double kNoTurn = 1e-12;  // sqrt(w^2 + z^2) under which the turn means nothing

}  // namespace

RigidState PlanarTransform::apply(const RigidState& state) const {
  const Eigen::Quaterniond q = turn();
  RigidState moved;
  moved.position = q * state.position + Eigen::Vector3d(x, y, 0);
  moved.position.z() = state.position.z();
  moved.orientation = q * state.orientation;
  moved.velocity = q * state.velocity;
  moved.angularVelocity = q * state.angularVelocity;
  return moved;
}

PlanarTransform PlanarTransform::after(const PlanarTransform& first) const {
  const Eigen::Quaterniond q = turn() * first.turn();
  const Eigen::Vector3d shift = turn() * Eigen::Vector3d(first.x, first.y, 0);
  return {q.w(), q.z(), shift.x() + x, shift.y() + y};
}

Registration registerState(const RigidState& moved, const RigidState& onto) {
  const Eigen::Quaterniond r = onto.orientation * moved.orientation.conjugate();
  const double inPlane = std::sqrt(r.w() * r.w() + r.z() * r.z());
  const double outOfPlane = std::sqrt(r.x() * r.x() + r.y() * r.y());
  Registration best;
  best.angle = 2 * portableAngle(outOfPlane, inPlane);
  PlanarTransform& t = best.transform;
  if (inPlane > kNoTurn) {
    t.halfCosine = r.w() / inPlane;
    t.halfSine = r.z() / inPlane;
  }
  const Eigen::Vector3d turned = t.turn() * moved.position;
  t.x = onto.position.x() - turned.x();
  t.y = onto.position.y() - turned.y();
  return best;
}

PlanarKey planarKey(const RigidState& state) {
  const Eigen::Quaterniond inverse = state.orientation.conjugate();
  return {inverse * Eigen::Vector3d::UnitZ(), inverse * state.velocity,
          inverse * state.angularVelocity};
}

double angleBetween(const PlanarKey& a, const PlanarKey& b) {
  // The chord and its complement: no loss near 0 or pi.
  return 2 * portableAngle((a.up - b.up).norm(), (a.up + b.up).norm());
}

}  // namespace ifa
