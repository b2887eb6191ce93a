// SPDX-License-Identifier: Apache-2.0
#include "connection/angular_connection.h"

#include <Eigen/LU>
#include <cmath>

#include "connection/free_turn.h"
#include "connection/rotation_vector.h"

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Share of its own size by which the matrix of a step is made larger on its diagonal: where the
/// slope is singular (a body that turns a whole number of times comes back whatever the axis) the
/// step stays finite.
constexpr double kLeastShare = 1e-9;

Quat<double> quat(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Quat<double> inverse(const Quat<double>& q) { return {q.w, -q.x, -q.y, -q.z}; }
Vec<double> vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d vector(const Vec<double>& v) { return {v.x, v.y, v.z}; }

/// Change of the first spin (body frame) that should make up for `miss`, the small turn (body frame
/// at the end) that leads from the end to the target.
Vector3d newtonStep(const BodyModel& model, const Matrix3d& slope, const Vector3d& miss,
                    ShootingStep kind) {
  // dL = W J^T lambda with W = I means dw = I^-1 N^T lambda for N = the slope by the spin.
  const Vec<double>& i = model.inverseInertia;
  const Matrix3d weighted = Vector3d(i.x, i.y, i.z).asDiagonal() * slope.transpose();
  Matrix3d square = slope * weighted;
  if (kind == ShootingStep::kSquaredAngle) {
    return weighted * miss * (miss.squaredNorm() / (2 * miss.dot(square * miss)));
  }
  square.diagonal().array() += kLeastShare * square.trace();
  return weighted * (square.inverse() * miss);
}

}  // namespace

AngularConnection angularConnection(const BodyModel& model, const Quaterniond& from,
                                    const Quaterniond& to, double duration, const Vector3d& guess,
                                    const ShootingSettings& settings) {
  const Quat<double> start = quat(from), target = quat(to);
  const Rotation<double> rotation(start);
  Vector3d spin = vector(rotation.transposed(vec(guess)));
  AngularConnection found;
  for (;; ++found.steps) {
    const FreeTurn turn = freeTurnWithSlope(model, {start, vec(spin)}, duration);
    const Vector3d miss = vector(rotationVector(inverse(turn.end.q) * target));
    found.missed = miss.norm();
    found.converged = found.missed <= settings.tolerance;
    if (found.converged || found.steps >= settings.mostSteps) {
      found.angularVelocity = vector(rotation * vec(spin));
      found.atEnd = vector(Rotation<double>(turn.end.q) * turn.end.w);
      return found;
    }
    Vector3d step = newtonStep(model, turn.slope, miss, settings.step);
    const double angle = step.norm() * duration;
    if (angle > settings.largestTurn) step *= settings.largestTurn / angle;
    if (!std::isfinite(angle)) return found;
    spin += step;
  }
}

Vector3d meanMomentumSpin(const BodyModel& model, const Quaterniond& from,
                          const Vector3d& spinFrom, const Quaterniond& to, const Vector3d& spinTo) {
  const Rotation<double> first(quat(from)), last(quat(to));
  const Vec<double> sum = angularMomentum(model, first, first.transposed(vec(spinFrom))) +
                          angularMomentum(model, last, last.transposed(vec(spinTo)));
  return vector(first * spinOfMomentum(model, first, sum * 0.5));
}

}  // namespace ifa
