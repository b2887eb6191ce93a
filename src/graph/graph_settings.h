// SPDX-License-Identifier: Apache-2.0
// Settings of the contact-event graph: what an edge weighs, and how its best ones are looked for.
#pragma once

#include <cstddef>

#include "affinity/factors.h"
#include "connection/connection.h"

namespace ifa {

/// What the linear part of eq. 3 compares v_blend with.
enum class VelocityReference {
  /// v_{i+}, which the contact impulse really has to make up. The default (docs/method.md, 4).
  kBlend,
  /// v_{j+}, as printed: after registration little more than the difference in height is left.
  kPrinted,
};

struct GraphSettings {
  /// Effect: kPrinted lets a path change its horizontal velocity for free.
  VelocityReference velocityReference = VelocityReference::kBlend;
  /// Time of the flight in v_blend and f_q: T* (kExact) or T_j (kBlend, as printed).
  ConnectionKind connection = ConnectionKind::kExact;
  /// Edges that are shown in another time than they were simulated in, silent ones and with kBlend
  /// all, are not there where T_eval (eq. 5) is not below this (5.3.2,
  /// ConnectionSettings::largestWarp).
  double largestWarp = 0.3;
  /// Equations 2 to 8, as printed.
  AffinityParameters affinity;
  /// Edges with a log f_v or log f_q under these are not there; -10 as printed (5.5).
  double leastVelocity = -10, leastOrientation = -10;
  /// Share by which the body may leave a contact with more energy than it came with; 0 as printed
  /// (eq. 10), more for music.
  double energyGain = 0;
  /// Most leaves of 32 events that a search looks into; 0: as many as its bounds ask for. Effect:
  /// fewer are faster and miss more (docs/neighbours.md).
  std::size_t mostLeaves = 2000;
  /// Each event also stands for its images under the body's symmetry group (docs/symmetry.md).
  /// Effect: off, the database is what it is, as in the paper.
  bool symmetry = true;
};

}  // namespace ifa
