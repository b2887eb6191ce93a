// SPDX-License-Identifier: Apache-2.0
// Whether a flight stays above the ground, found from the motion of the vertices and not by
// sampling it.
#pragma once

#include <optional>

#include "dynamics/body_model.h"
#include "model/rigid_state.h"

namespace ifa {

/// First time at which some vertex of the hull goes under -`depth` on the flight from `departure`,
/// s after it and before `duration`; none when all stay above. The kernel's own search for first
/// touches (FlightSegment), let down by `depth`: candidate vertices by a bound on their bend, the
/// height over a segment as a cubic within 7e-5 of the body's radius, refined on the exact motion.
/// A departure that is already deeper goes under at 0 unless it rises. Thread safe.
/// @param duration  s
/// @param depth     m, >= 0; Body::tolerance() is what a motion may sink (docs/method.md 8)
[[nodiscard]] std::optional<double> goesUnder(const BodyModel& model, const RigidState& departure,
                                              double duration, double depth);

}  // namespace ifa
