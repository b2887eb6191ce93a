// SPDX-License-Identifier: Apache-2.0
// What many drops of a body have in common: the figures that surfaces are calibrated by, and by
// which one simulator is compared with another.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "body/body.h"
#include "dynamics/simulator.h"
#include "ifa/event_cut.h"
#include "model/contact_event.h"
#include "sampler/event_recorder.h"

namespace ifa {

/// How the audible events of `body` on `surface` are found; J_ref is the surface's.
[[nodiscard]] RecorderSettings audibleCut(const Body& body, const SurfaceProperties& surface);
/// All events of a drop. By the paper's cut the last one ends where the drop came to rest: the
/// resting contact is clipped (IFA section 4).
[[nodiscard]] std::vector<ContactEvent> eventsOf(const DropResult& drop,
                                                 const RecorderSettings& settings);
/// The paper's own cut: any impulse above zero.
[[nodiscard]] RecorderSettings paperCut(const Body& body);
/// The one or the other.
[[nodiscard]] RecorderSettings recorderFor(EventCut cut, const Body& body,
                                           const SurfaceProperties& surface);

/// sqrt(2 E / m) with the kinetic energy E of translation and spin, m/s.
[[nodiscard]] double kineticSpeed(const Body& body, const RigidState& state);

/// When the motion is over, to the eye: the end of the last impact or contact step that began with
/// a kinetic speed over `speed` (m/s); s. Unlike DropResult::restTime it does not depend on how a
/// simulator decides that a body rests.
[[nodiscard]] double timeToRest(const Body& body, const std::vector<ContactStep>& steps,
                                double speed = 0.05);

/// One number per drop, in order of the drops, except for `gaps`.
struct DropStatistics {
  std::vector<double> paperEvents;     ///< number of events by the paper's cut
  std::vector<double> audibleEvents;   ///< number of audible events
  std::vector<double> largestImpulse;  ///< largest impulse in 1 ms, N s
  std::vector<double> restTimes;       ///< timeToRest, s
  std::vector<double> gaps;            ///< from each audible event's start to the next one's, s
  std::size_t unfinished = 0;          ///< drops that the time limit ended
};

using Simulate = std::function<DropResult(const RigidState& start)>;

/// Drops the body from initial states 0 to `count` - 1 of the family `seed`, on all cores.
/// @param simulate  thread safe
[[nodiscard]] DropStatistics gatherStatistics(const Body& body, const SurfaceProperties& surface,
                                              const Simulate& simulate, std::uint64_t seed,
                                              std::size_t count);

[[nodiscard]] double mean(const std::vector<double>& values);  ///< 0 for none
[[nodiscard]] double median(std::vector<double> values);       ///< upper one; 0 for none
/// Largest distance between the two empirical distributions (Kolmogorov-Smirnov D). Ties count
/// once; 1 when just one of them is empty.
[[nodiscard]] double distributionDistance(std::vector<double> a, std::vector<double> b);

}  // namespace ifa
