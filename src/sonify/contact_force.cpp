// SPDX-License-Identifier: Apache-2.0
#include "sonify/contact_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifa {

double contactTime(const Body& body, const Strike& strike, const SoundMaterial& material,
                   const SoundMaterial& floor) {
  const Eigen::Vector3d turn = strike.point.cross(strike.direction);
  const double mass = 1 / (1 / body.mass + turn.dot(body.inertia.inverse() * turn));
  // Half of what the impulse changes is the speed of approach, the rest that of the rebound.
  const double speed = std::max(1e-3, strike.impulse / (2 * mass));
  const auto softness = [](const SoundMaterial& m) {
    return (1 - m.poisson * m.poisson) / m.young;
  };
  const double stiffness = 1 / (softness(material) + softness(floor));
  const double radius = 0.1 * body.size;
  return 2.87 * std::pow(mass * mass / (radius * stiffness * stiffness * speed), 0.2);
}

ForcePulse forcePulse(double impulse, double start, double length, int rate) {
  ForcePulse pulse;
  pulse.first = static_cast<std::size_t>(start * rate);
  const auto end = static_cast<std::size_t>((start + length) * rate);
  pulse.force.reserve(end - pulse.first + 1);
  // Share of the impulse that is over at a time.
  const auto given = [&](double time) {
    const double phase = std::clamp((time - start) / length, 0.0, 1.0);
    return (1 - std::cos(std::numbers::pi * phase)) / 2;
  };
  for (std::size_t i = pulse.first; i <= end; ++i) {
    const double from = static_cast<double>(i) / rate, to = static_cast<double>(i + 1) / rate;
    pulse.force.push_back(impulse * rate * (given(to) - given(from)));
  }
  return pulse;
}

}  // namespace ifa
