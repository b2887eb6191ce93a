// SPDX-License-Identifier: Apache-2.0
// A query in the coordinates of the event tree, and the two loops that most of a search's time goes
// to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "body/body.h"
#include "graph/edge_weight.h"

namespace ifa {

/// What a leaf keeps of a flight. All are seen from the body in its pose at j+.
enum TreeColumn : std::size_t {
  kUpX,  ///< the plane's normal
  kUpY,
  kUpZ,
  kFlightX,  ///< mean velocity of the flight: way of the centre of mass / T_j, m/s
  kFlightY,
  kFlightZ,
  kSpinX,  ///< omega_{j+}, rad/s
  kSpinY,
  kSpinZ,
  kTime,           ///< T_j, s
  kHeardLoud,      ///< amplitude of k, N s
  kHeardDuration,  ///< filtered, s
  kHeardCentroid,  ///< s; 0 where the duration is
  kHeight,         ///< of j+, m
  kTreeColumns
};
inline constexpr std::size_t kLeafEvents = 32;
inline constexpr std::size_t kFanOut = 16;

/// Boxes around up to kFanOut children.
struct alignas(64) TreeNode {
  std::array<std::array<float, kFanOut>, kTreeColumns> low, high;
  /// Number of a node, or of a leaf with kLeafBit; kNoChild where there is none.
  std::array<std::uint32_t, kFanOut> child;

  static constexpr std::uint32_t kLeafBit = 0x80000000U, kNoChild = 0xFFFFFFFFU;
};

/// v' A v for a plausible region: across |v|^2 - (across - along) (axis . v)^2.
struct RegionForm {
  std::array<float, 3> axis{};
  float across = 0;      ///< 1 / half-axis^2 across the change
  float difference = 0;  ///< across less that along it
};

/// One query, single precision, in the source's body frame at i+.
struct TreeQuery {
  TreeQuery(const Body& body, const GraphSettings& settings, const TransitionSource& source,
            const TransitionTarget& target);

  std::array<float, 3> up, velocity, spin;
  RegionForm linear, angular;
  float height;
  float time;                   ///< T*, s
  float fixedTime, ownTime;     ///< of the flight: fixedTime + ownTime T_j
  float keepSource, keepOwn;    ///< 1 and 0, or 0 and 1 where v_{j+} is what eq. 3 compares with
  float orientation, longTime;  ///< c_q and T_0 of eq. 4
  float timeWarp, mostWarp;     ///< c_t, and the largest -log f_t that can be shown
  float loud, loudness;         ///< amplitude asked for, N s, and c_a / (N s)^2
  float duration, centroid, sound;        ///< s, and c_Delta
  float leastVelocity, leastOrientation;  ///< as positive numbers, widened by rounding
  float squaredSpeed;            ///< energy to leave with, as the square of a speed; likewise
  std::array<float, 3> moments;  ///< over the mass, m^2
};

/// Log weights of a leaf's events; -infinity where there is no edge.
void weighLeaf(const float* leaf, const TreeQuery& query, float* weights);
/// What the best event in each child's box could weigh. Not a strict bound: the turn that lays j
/// over i is taken from the place in the box that is nearest to the query.
void weighBoxes(const TreeNode& node, const TreeQuery& query, float* weights);

}  // namespace ifa
