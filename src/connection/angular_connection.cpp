// SPDX-License-Identifier: Apache-2.0
#include "connection/angular_connection.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "connection/free_turn.h"
#include "connection/rotation_vector.h"

namespace ifa {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Levenberg and Marquardt's damping, as a share of the matrix of a step: what it starts with, its
/// least, and by what it changes after a step that came nearer and one that did not.
constexpr double kFirstDamping = 1e-6, kLeastDamping = 1e-15, kLess = 0.01, kMore = 30;
constexpr double kNoStep = 1e-13;  // rad: where the damping has left nothing of a step
constexpr int kTries = 5;
constexpr double kOtherTurn[kTries] = {0, 1, -1, 2, -2};  // rad

Quat<double> quat(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Quat<double> inverse(const Quat<double>& q) { return {q.w, -q.x, -q.y, -q.z}; }
Vec<double> vec(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d vector(const Vec<double>& v) { return {v.x, v.y, v.z}; }

/// Change of the first spin (body frame) that should make up for `miss`, the small turn (body frame
/// at the end) that leads from the end to the target.
Vector3d newtonStep(const BodyModel& model, const Matrix3d& slope, const Vector3d& miss,
                    ShootingStep kind, double damping) {
  // dL = W J^T lambda with W = I means dw = I^-1 N^T lambda for N = the slope by the spin.
  const Vec<double>& i = model.inverseInertia;
  const Matrix3d weighted = Vector3d(i.x, i.y, i.z).asDiagonal() * slope.transpose();
  Matrix3d square = slope * weighted;
  if (kind == ShootingStep::kSquaredAngle) {
    return weighted * miss * (miss.squaredNorm() / (2 * miss.dot(square * miss)));
  }
  square.diagonal().array() += damping * square.trace();
  return weighted * (square.inverse() * miss);
}

/// Where a first spin leads.
struct Landing {
  Vector3d spin;  ///< body frame at the start, rad/s
  FreeTurn turn;
  Vector3d miss;  ///< small turn from there to the target, body frame at the end, rad
};

/// The boundary value problem.
struct Shot {
  const BodyModel& model;
  Quat<double> from, to;
  double duration;

  [[nodiscard]] Landing at(const Vector3d& spin) const {
    const FreeTurn turn = freeTurnWithSlope(model, {from, vec(spin)}, duration);
    return {spin, turn, vector(rotationVector(inverse(turn.end.q) * to))};
  }
};

/// Newton steps from `best`, which is left at the best spin found. Returns their number.
int shoot(const Shot& shot, const ShootingSettings& settings, Landing& best) {
  const bool always = settings.step == ShootingStep::kSquaredAngle;
  double damping = kFirstDamping;
  int steps = 0;
  for (; best.miss.norm() > settings.tolerance && steps < settings.mostSteps; ++steps) {
    Vector3d step = newtonStep(shot.model, best.turn.slope, best.miss, settings.step, damping);
    const double angle = step.norm() * shot.duration;
    if (!(angle > kNoStep)) break;
    if (angle > settings.largestTurn) step *= settings.largestTurn / angle;
    const Landing next = shot.at(best.spin + step);
    const bool nearer = next.miss.norm() < best.miss.norm();
    damping = nearer ? std::max(kLeastDamping, damping * kLess) : damping * kMore;
    if (nearer || always) best = next;
  }
  return steps;
}

/// With all moments equal the body turns about one axis, and all spins that do it are known: those
/// of the rotation between the orientations, with whole turns added. The nearest to `guess`.
AngularConnection evenSpin(const Shot& shot, const Vector3d& guess) {
  constexpr double kNoAxis = 1e-12, kWhole = 6.283185307179586;
  const Vector3d between = vector(rotationVector(shot.to * inverse(shot.from)));
  const double angle = between.norm();
  const bool some = angle > kNoAxis || !(guess.norm() > 0);
  const Vector3d axis = some ? Vector3d(between / std::max(angle, kNoAxis)) : guess.normalized();
  const double turns = std::round((guess.dot(axis) * shot.duration - angle) / kWhole);
  AngularConnection found;
  found.converged = true;
  found.angularVelocity = axis * ((angle + turns * kWhole) / shot.duration);
  found.atEnd = found.angularVelocity;
  return found;
}

}  // namespace

AngularConnection angularConnection(const BodyModel& model, const Quaterniond& from,
                                    const Quaterniond& to, double duration, const Vector3d& guess,
                                    const ShootingSettings& settings) {
  const Shot shot{model, quat(from), quat(to), duration};
  const Rotation<double> rotation(shot.from);
  if (model.isotropic && settings.step == ShootingStep::kVector) return evenSpin(shot, guess);
  const Vector3d first = vector(rotation.transposed(vec(guess)));
  Landing best = shot.at(first);
  AngularConnection found;
  const int tries = settings.step == ShootingStep::kVector ? kTries : 1;
  for (int i = 0; i < tries; ++i) {
    if (i > 0) best = shot.at(first * (1 + kOtherTurn[i] / (first.norm() * duration)));
    found.steps += shoot(shot, settings, best);
    if (best.miss.norm() <= settings.tolerance) break;
  }
  found.missed = best.miss.norm();
  found.converged = found.missed <= settings.tolerance;
  found.angularVelocity = vector(rotation * vec(best.spin));
  found.atEnd = vector(Rotation<double>(best.turn.end.q) * best.turn.end.w);
  return found;
}

Vector3d meanMomentumSpin(const BodyModel& model, const Quaterniond& from, const Vector3d& spinFrom,
                          const Quaterniond& to, const Vector3d& spinTo) {
  const Rotation<double> first(quat(from)), last(quat(to));
  const Vec<double> sum = angularMomentum(model, first, first.transposed(vec(spinFrom))) +
                          angularMomentum(model, last, last.transposed(vec(spinTo)));
  return vector(first * spinOfMomentum(model, first, sum * 0.5));
}

}  // namespace ifa
