// SPDX-License-Identifier: Apache-2.0
#include "audit/flight.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifa::audit_detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kLargestTurn = 0.01;  // rad per step of the integrator
constexpr double kMostSteps = 100000;  // only a broken file asks for more

/// Torque-free rotation: the angular momentum in the world frame does not change.
class FreeRotation {
 public:
  FreeRotation(const Vector3d& momentum, const Matrix3d& inertia)
      : momentum_(momentum), inverse_(inertia.inverse()) {}

  [[nodiscard]] Vector3d velocity(const Quaterniond& q) const {
    return q * (inverse_ * (q.conjugate() * momentum_));
  }
  [[nodiscard]] Quaterniond step(const Quaterniond& q, double dt) const {
    const Vector4d k1 = rate(q.coeffs());
    const Vector4d k2 = rate(q.coeffs() + 0.5 * dt * k1);
    const Vector4d k3 = rate(q.coeffs() + 0.5 * dt * k2);
    const Vector4d k4 = rate(q.coeffs() + dt * k3);
    return Quaterniond((q.coeffs() + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4)).eval()).normalized();
  }

 private:
  [[nodiscard]] Vector4d rate(const Vector4d& coefficients) const {
    const Quaterniond q(coefficients);
    const Vector3d omega = velocity(q.normalized());
    return 0.5 * (Quaterniond(0, omega.x(), omega.y(), omega.z()) * q).coeffs();
  }

  Vector3d momentum_;
  Matrix3d inverse_;
};

}  // namespace

Vector3d angularMomentum(const MotionSample& sample, const Matrix3d& inertia) {
  return sample.orientation * (inertia * (sample.orientation.conjugate() * sample.angularVelocity));
}

MotionSample flyFreely(const MotionSample& from, double duration, double gravity,
                       const Matrix3d& inertia) {
  const Vector3d fall(0, 0, -gravity);
  const FreeRotation rotation(angularMomentum(from, inertia), inertia);
  // The rate can grow during the flight, but not beyond the momentum over the smallest moment.
  const double turn = from.angularVelocity.norm() * duration;
  const double steps = std::clamp(std::ceil(turn / kLargestTurn), 1.0, kMostSteps);
  MotionSample to = from;
  for (double i = 0; i < steps; ++i) {
    to.orientation = rotation.step(to.orientation, duration / steps);
  }
  to.time = from.time + duration;
  to.angularVelocity = rotation.velocity(to.orientation);
  to.velocity = from.velocity + duration * fall;
  to.position = from.position + duration * from.velocity + 0.5 * duration * duration * fall;
  return to;
}

double lowestVertex(const MotionSample& sample, const std::vector<Vector3d>& hull) {
  const Vector3d up = sample.orientation.conjugate() * Vector3d::UnitZ();
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& vertex : hull) lowest = std::min(lowest, up.dot(vertex));
  return sample.position.z() + lowest;
}

}  // namespace ifa::audit_detail
