// SPDX-License-Identifier: Apache-2.0
// A prism that rolls from face to face, for our kernel and for ODE.
#pragma once

#include <cmath>

#include "model/rigid_state.h"
#include "support/box_body.h"

namespace ifa {

class RollingPrismCase {
 public:
  /// @param radius  of its corners, m. @param spin  to begin with, rad/s
  RollingPrismCase(int sides, double radius, double spin)
      : body(makePrismBody(sides, radius, 0.05, 0.1)),
        radius_(radius),
        spin_(spin),
        half_(3.14159265358979323846 / sides) {
    start.position.z() = radius * std::cos(half_);
    start.angularVelocity.x() = -spin;
    start.velocity = spin * radius * Eigen::Vector3d(0, std::cos(half_), std::sin(half_));
    surface.restitution = 0;
    surface.friction = 2;
  }

  /// Faces that it rolls over, losing at each what an inelastic slap takes: about its leading edge
  /// every face that slaps down takes the same share of the spin.
  [[nodiscard]] int facesByTheBook() const {
    const double lever = body.mass * radius_ * radius_;
    const double aboutEdge = body.principalMoments.x() + lever;
    const double kept = 1 - lever * (1 - std::cos(2 * half_)) / aboutEdge;
    const double barrier = body.mass * kGravity * radius_ * (1 - std::cos(half_));
    int faces = 0;
    for (double spin = spin_; aboutEdge * spin * spin / 2 > barrier; spin *= kept) ++faces;
    return faces;
  }
  /// Faces between the start and `rest`.
  [[nodiscard]] double facesRolled(const RigidState& rest) const {
    return rest.position.y() / (2 * radius_ * std::sin(half_));
  }

  Body body;
  SurfaceProperties surface;
  RigidState start;

 private:
  double radius_, spin_, half_;
};

}  // namespace ifa
