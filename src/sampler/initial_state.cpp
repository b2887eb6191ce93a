// SPDX-License-Identifier: Apache-2.0
#include "sampler/initial_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace ifa {
namespace {

/// Sine of 0 to 90 degrees by its power series: the library's may differ in the last bit from
/// machine to machine.
double sineOfDegrees(double degrees) {
  const double x = std::clamp(degrees, 0.0, 90.0) * (3.14159265358979323846 / 180.0);
  double term = x, sum = x;
  for (int k = 2; k < 26; k += 2) {
    term *= -x * x / (k * (k + 1));
    sum += term;
  }
  return std::min(sum, 1.0);
}

struct DiscPoint {
  double x, y, squaredRadius;
};

/// Uniform in the open unit disc, the centre excluded.
DiscPoint sampleDisc(RandomStream& random) {
  while (true) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    const double squared = x * x + y * y;
    if (squared < 1 && squared > 0) return {x, y, squared};
  }
}

/// Marsaglia 1972: uniform on the sphere.
Eigen::Vector3d sampleDirection(RandomStream& random) {
  const DiscPoint p = sampleDisc(random);
  const double scale = 2 * std::sqrt(1 - p.squaredRadius);
  return {scale * p.x, scale * p.y, 1 - 2 * p.squaredRadius};
}

/// Marsaglia 1972: uniform over rotations.
Eigen::Quaterniond sampleOrientation(RandomStream& random) {
  const DiscPoint p = sampleDisc(random);
  const DiscPoint q = sampleDisc(random);
  const double scale = std::sqrt((1 - p.squaredRadius) / q.squaredRadius);
  return {p.x, p.y, scale * q.x, scale * q.y};
}

/// Lambert's law by Malley: a uniform point of the disc lifted to the sphere. The disc's radius is
/// the sine of the cone's half-angle.
Eigen::Vector3d sampleDownward(RandomStream& random, double coneDegrees) {
  const DiscPoint p = sampleDisc(random);
  const double sine = sineOfDegrees(coneDegrees);
  return {sine * p.x, sine * p.y, -std::sqrt(1 - sine * sine * p.squaredRadius)};
}

/// Height of the lowest hull vertex over the centre of mass (negative), m. Spelt out, because a
/// matrix library may sum in another order on another machine.
double lowestVertex(const Body& body, const Eigen::Quaterniond& q) {
  const double ux = 2 * (q.x() * q.z() - q.w() * q.y());
  const double uy = 2 * (q.y() * q.z() + q.w() * q.x());
  const double uz = 1 - 2 * (q.x() * q.x() + q.y() * q.y());
  const Eigen::Matrix3d& r = body.bodyFromPrincipal;
  std::array<double, 3> up{};
  for (int i = 0; i < 3; ++i)
    up[static_cast<std::size_t>(i)] = (r(i, 0) * ux + r(i, 1) * uy) + r(i, 2) * uz;
  double lowest = std::numeric_limits<double>::max();
  for (const Eigen::Vector3d& v : body.hull)
    lowest = std::min(lowest, (up[0] * v.x() + up[1] * v.y()) + up[2] * v.z());
  return lowest;
}

}  // namespace

RigidState sampleInitialState(const Body& body, std::uint64_t seed, std::uint64_t index) {
  const SamplingSettings& sampling = body.definition.sampling;
  RandomStream random(seed, index);
  RigidState state;
  state.orientation = sampleOrientation(random);
  state.position.z() = -lowestVertex(body, state.orientation);
  const double speed = random.uniform(sampling.speed[0], sampling.speed[1]);
  state.velocity = speed * sampleDownward(random, sampling.coneDegrees);
  const double spin = random.uniform(sampling.spin[0], sampling.spin[1]);
  state.angularVelocity = spin * sampleDirection(random);
  return state;
}

}  // namespace ifa
