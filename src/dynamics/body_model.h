// SPDX-License-Identifier: Apache-2.0
// What the kernel needs to know of a body and a surface, laid out for its loops.
#pragma once

#include <vector>

#include "body/body.h"
#include "dynamics/lane.h"
#include "model/rigid_state.h"

namespace ifa {

/// Vertices that would hit within this time hit together, s: an impact of a hard body lasts as
/// long.
inline constexpr double kTogether = 1.5e-4;

/// Constants of the stepping scheme (docs/dynamics.md gives the reasons).
struct KernelSettings {
  double step = 1e-3;         ///< s, longest step in contact of a body the size of a die
  double stepAngle = 0.03;    ///< rad, largest turn in one step in contact
  double bounceSpeed = 0.02;  ///< m/s, slower impacts do not bounce
  double restSpeed = 0.02;    ///< m/s, kinetic speed under which a supported body is at rest
  double segmentAngle = 0.4;  ///< rad, turn covered by one series of a flight
  double isotropicAngle =
      0.7;              ///< likewise where all moments are equal and the series converges faster
  int iterations = 12;  ///< sweeps of the contact solver, at most
  int impactIterations = 30;  ///< likewise for an impact
};

/// Hull vertices in rows, filled up with copies of the last one to a multiple of kChunk, so that
/// loops over whole chunks need no tail.
struct VertexRows {
  static constexpr std::size_t kChunk = 4;

  std::vector<double> x, y, z;  ///< principal frame, m

  void add(double px, double py, double pz);
  void fillUp();
  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// Body and surface in principal axes. Immutable once made; share it between threads.
struct BodyModel {
  BodyModel(const Body& body, const SurfaceProperties& surface, const KernelSettings& kernel = {});

  std::vector<double> x, y, z;  ///< hull vertices, principal frame, m
  VertexRows rows;              ///< the same, filled up
  double mass, inverseMass;
  Vec<double> inertia, inverseInertia;  ///< principal moments
  Vec<double> euler;                    ///< (I2 - I3) / I1 and cyclic
  bool isotropic;                       ///< all moments equal: spin is constant in flight
  int symmetryAxis = -1;  ///< 0 or 2: the other two moments are equal; -1: they are not
  double radius;          ///< m
  double step;            ///< longest step in contact, s
  double slop;            ///< gap that counts as touching, m
  double hitGap;          ///< gap in which a vertex is hit or held, m
  double speedRoot;       ///< speed of any point is at most this times the root of 2 E, kg^-1/2
  SurfaceProperties surface;
  KernelSettings settings;
};

}  // namespace ifa
