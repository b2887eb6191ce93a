// SPDX-License-Identifier: Apache-2.0
// A contact event as the event database keeps it: single precision, freed of its place on the
// ground.
#pragma once

#include <array>
#include <cstdint>

#include "model/rigid_state.h"

namespace ifa {

/// A RigidState in single precision, without x and y. World frame, principal axes.
struct PackedState {
  float height = 0;                                    ///< of the centre of mass, m
  std::array<float, 4> orientation = {1, 0, 0, 0};     ///< w, x, y, z
  std::array<float, 3> velocity{}, angularVelocity{};  ///< m/s, rad/s

  bool operator==(const PackedState&) const = default;
};

/// Rounds to the nearest floats.
[[nodiscard]] PackedState pack(const RigidState& state);
/// At x = y = 0, the orientation made a rotation again. The same bits everywhere: what starts from
/// it can be simulated again.
[[nodiscard]] RigidState unpack(const PackedState& packed);

/// One event and what joins it to the next one of its simulation. IFA 5.2; docs/database.md.
struct EventRecord {
  enum Flag : std::uint32_t {
    kTerminal = 1,       ///< brings the body to rest
    kFollowed = 2,       ///< the next record is the next event; gap and next are set
    kSilentPassage = 4,  ///< the body touches on the way there: no flight
    kTouchingAfter = 8   ///< the body still touches at the event's end
  };
  static constexpr std::size_t kFloats = 30;

  PackedState before;            ///< pre-contact state, at the event's start
  PackedState after;             ///< post-contact state, at its end
  std::array<float, 2> shift{};  ///< x, y of `after` as seen from `before`, m
  float duration = 0;            ///< s, the true one, unfiltered
  float amplitude = 0;           ///< two-norm of the audible excess impulses, N s
  float centroid = 0;            ///< eq. 8, s after the start
  float gap = 0;                 ///< s from the end to the next event's start
  std::array<float, 2> next{};   ///< x, y of the next pre-contact state as seen from `before`, m
  std::uint32_t flags = 0;

  [[nodiscard]] bool has(Flag flag) const { return (flags & flag) != 0; }
};
static_assert(sizeof(EventRecord) == sizeof(float) * (EventRecord::kFloats + 1));

}  // namespace ifa
