// SPDX-License-Identifier: Apache-2.0
// Flight by Runge and Kutta in small steps: slow, and with nothing in common with the kernel's.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "body/body.h"
#include "model/rigid_state.h"

namespace ifa::test {

class ReferenceFlight {
 public:
  ReferenceFlight(const Body& body, const RigidState& start)
      : body_(body), state_(start), momentum_(worldInertia(start) * start.angularVelocity) {}

  void advance(double duration) {
    const int steps = std::max(1, static_cast<int>(std::ceil(duration / 5e-5)));
    for (int i = 0; i < steps; ++i) turn(duration / steps);
    state_.position += duration * state_.velocity;
    state_.position.z() -= 0.5 * kGravity * duration * duration;
    state_.velocity.z() -= kGravity * duration;
    state_.angularVelocity = spin(state_.orientation);
  }

  [[nodiscard]] const RigidState& state() const { return state_; }
  /// Height of the lowest vertex of the hull above the ground, m.
  [[nodiscard]] double clearance() const {
    const Eigen::Matrix3d axes(state_.orientation);
    double lowest = 1e9;
    for (const Eigen::Vector3d& vertex : body_.hull) {
      const Eigen::Vector3d p = body_.bodyFromPrincipal.transpose() * vertex;
      lowest = std::min(lowest, state_.position.z() + (axes * p).z());
    }
    return lowest;
  }

 private:
  [[nodiscard]] Eigen::Matrix3d worldInertia(const RigidState& state) const {
    const Eigen::Matrix3d axes(state.orientation);
    return axes * body_.principalMoments.asDiagonal() * axes.transpose();
  }
  /// Spin that the constant angular momentum means in this pose.
  [[nodiscard]] Eigen::Vector3d spin(const Eigen::Quaterniond& q) const {
    const Eigen::Matrix3d axes(q);
    return axes * (axes.transpose() * momentum_).cwiseQuotient(body_.principalMoments);
  }
  [[nodiscard]] Eigen::Vector4d rate(const Eigen::Vector4d& coeffs) const {
    const Eigen::Quaterniond q(coeffs);
    const Eigen::Vector3d w = spin(q.normalized());
    return 0.5 * (Eigen::Quaterniond(0, w.x(), w.y(), w.z()) * q).coeffs();
  }
  void turn(double step) {
    const Eigen::Vector4d q = state_.orientation.coeffs();
    const Eigen::Vector4d a = rate(q), b = rate(q + step / 2 * a), c = rate(q + step / 2 * b);
    const Eigen::Vector4d d = rate(q + step * c);
    state_.orientation.coeffs() = q + step / 6 * (a + 2 * b + 2 * c + d);
    state_.orientation.normalize();
  }

  const Body& body_;
  RigidState state_;
  Eigen::Vector3d momentum_;
};

}  // namespace ifa::test
