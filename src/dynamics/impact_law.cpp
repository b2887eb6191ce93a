// SPDX-License-Identifier: Apache-2.0
#include "dynamics/impact_law.h"

#include <cmath>

#include "dynamics/energy.h"

namespace ifa {

namespace {

/// Impulses are solved to this change of speed, m/s.
constexpr double kPrecision = 3e-4;

Impact solved(const BodyModel& body, const Rotation<double>& rotation, double restitution,
              const Vec<double>& velocity, const Vec<double>& w, ContactSolver<double>& solver) {
  for (int k = 0; k < solver.count; ++k) {
    ContactPoint<double>& p = solver.points[k];
    p.target = {0, 0, p.rate < -body.settings.bounceSpeed ? -restitution * p.rate : 0};
    p.impulse = {};
  }
  solver.moment = solver.spinTarget = {};
  solver.rollingArm = body.surface.rollingFriction;
  Impact impact{velocity, rotation * w, {}};
  solver.solve(body, WorldInertia<double>(body, rotation), body.settings.impactIterations,
               kPrecision * body.mass, impact.velocity, impact.w);
  impact.w = rotation.transposed(impact.w);
  impact.impulse = solver.total();
  return impact;
}

double energyOf(const BodyModel& body, const Impact& impact) {
  return kineticEnergy(body, impact.velocity, impact.w);
}

/// The point between a plastic impact, which gains nothing, and a full one, which does, that has
/// energy `energy`.
Impact between(const BodyModel& body, const Impact& plastic, const Impact& full, double energy) {
  const Impact way = {full.velocity - plastic.velocity, full.w - plastic.w,
                      full.impulse - plastic.impulse};
  const double a = energyOf(body, way), c = energyOf(body, plastic) - energy;
  const double b = body.mass * dot(plastic.velocity, way.velocity) +
                   body.inertia.x * plastic.w.x * way.w.x + body.inertia.y * plastic.w.y * way.w.y +
                   body.inertia.z * plastic.w.z * way.w.z;
  // Energy along the way is a s^2 + b s + c, with c <= 0 and the whole above 0 at s = 1.
  const double root = std::sqrt(laneMax(0, b * b - 4 * a * c)) - b;
  const double s = a > 0 ? laneMax(0, laneMin(1, root / (2 * a))) : 0;
  return {plastic.velocity + way.velocity * s, plastic.w + way.w * s,
          plastic.impulse + way.impulse * s};
}

}  // namespace

Impact solveImpact(const BodyModel& body, const Rotation<double>& rotation, double restitution,
                   const Vec<double>& velocity, const Vec<double>& w,
                   ContactSolver<double>& solver) {
  const double energy = kineticEnergy(body, velocity, w);
  Impact impact = solved(body, rotation, restitution, velocity, w, solver);
  if (energyOf(body, impact) <= energy) return impact;
  impact = between(body, solved(body, rotation, 0, velocity, w, solver), impact, energy);
  // Sweeps that have not settled may leave even a plastic impact above; rounding may as well.
  const double after = energyOf(body, impact);
  if (after > energy) {
    const double scale = std::sqrt(energy / after) * (1 - 1e-15);
    impact.impulse = impact.impulse + impact.velocity * ((scale - 1) * body.mass);
    impact.velocity = impact.velocity * scale;
    impact.w = impact.w * scale;
  }
  return impact;
}

}  // namespace ifa
