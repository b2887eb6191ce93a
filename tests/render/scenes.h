// SPDX-License-Identifier: Apache-2.0
// Bodies and motions whose pictures can be worked out by hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "body/body.h"
#include "body/shapes.h"
#include "ifa/motion.h"
#include "render/moment.h"

namespace ifa::test {

/// One material for all of it.
inline Body bodyOf(Mesh mesh, const std::array<double, 4>& colour = {0.8, 0.8, 0.8, 1},
                   double roughness = 1, double metallic = 0) {
  Body body;
  body.definition.name = "thing";
  mesh.materials = {{"all", colour, roughness, metallic}};
  mesh.triangleMaterial.assign(mesh.triangles.size(), 0);
  body.hull = mesh.vertices;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    body.radius = std::max(body.radius, vertex.norm());
  }
  body.size = 2 * body.radius;
  body.mass = 0.01;
  body.mesh = std::move(mesh);
  return body;
}

/// A cube of `side` m.
inline Body cubeOf(double side, const std::array<double, 4>& colour = {0.8, 0.8, 0.8, 1},
                   double roughness = 1) {
  return bodyOf(shapes::box(Eigen::Vector3d::Constant(side)), colour, roughness);
}

/// Moves evenly from t = 0 on, `seconds` long, with a contact at its start.
inline Motion evenMotion(const Eigen::Vector3d& from, const Eigen::Vector3d& velocity,
                         double seconds = 0.5) {
  Motion motion;
  motion.object = {"thing", "thing.obj", "desk", 0.01, 0.5, 0.3};
  motion.success = true;
  const int count = std::max(1, static_cast<int>(std::ceil(seconds * 240)));
  for (int i = 0; i <= count; ++i) {
    MotionSample sample;
    sample.time = seconds * i / count;
    sample.position = from + sample.time * velocity;
    sample.velocity = velocity;
    motion.trajectory.push_back(sample);
  }
  MotionContact contact;
  contact.position = from;
  motion.contacts = {contact};
  return motion;
}

inline Motion restAt(const Eigen::Vector3d& place) {
  return evenMotion(place, Eigen::Vector3d::Zero());
}

inline render::Actor actorOf(const Body& body, const Motion& motion, double start = 0) {
  render::Actor actor;
  actor.geometry = std::make_shared<render::BodyGeometry>(body);
  actor.motion = std::make_shared<const Motion>(motion);
  actor.start = start;
  return actor;
}

/// Numbers in [0, 1), the same in every run.
class Lottery {
 public:
  explicit Lottery(std::uint64_t seed = 1) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  float single() { return static_cast<float>((*this)()) * 0.9999999f; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  /// Even over the sphere.
  render::Vector direction() {
    const double z = between(-1, 1), angle = between(0, 6.283185307179586);
    const double r = std::sqrt(1 - z * z);
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>().normalized();
  }

 private:
  std::uint64_t state_;
};

/// Calls `use(direction, solid angle)` for directions that fill the upper half of the sphere.
template <class Use>
void overHemisphere(int rows, const Use& use) {
  constexpr double kTurn = 6.283185307179586;
  const int columns = 4 * rows;
  for (int row = 0; row < rows; ++row) {
    const double z = (row + 0.5) / rows, r = std::sqrt(1 - z * z);
    for (int column = 0; column < columns; ++column) {
      const double angle = kTurn * (column + 0.5) / columns;
      use(Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z).cast<float>().eval(),
          static_cast<float>(kTurn / rows / columns));
    }
  }
}

}  // namespace ifa::test
