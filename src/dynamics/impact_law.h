// SPDX-License-Identifier: Apache-2.0
// Newton restitution at every vertex that hits, without ever gaining energy.
#pragma once

#include "dynamics/contact_solver.h"

namespace ifa {

/// What an impact changes.
struct Impact {
  Vec<double> velocity{};  ///< world frame, m/s
  Vec<double> w{};         ///< body frame, rad/s
  Vec<double> impulse{};   ///< sum over all points, N s
};

/// Solves the impact of the points gathered in `solver` (vertex, gap, rate, r). Where friction
/// would let full restitution gain energy, as much of it is taken as gains none.
[[nodiscard]] Impact solveImpact(const BodyModel& body, const Rotation<double>& rotation,
                                 double restitution, const Vec<double>& velocity,
                                 const Vec<double>& w, ContactSolver<double>& solver);

}  // namespace ifa
