// SPDX-License-Identifier: Apache-2.0
// A contact-time signature as a listener would have noted it from a simulated drop: the planners'
// test input, of which a true motion is known to exist.
#pragma once

#include <vector>

#include "base/random.h"
#include "body/body.h"
#include "ifa/contact_signature.h"
#include "model/contact_event.h"

namespace ifa {

/// How wrong the listener is: each value uniform in plus or minus the number given.
struct ListenerSettings {
  double startJitter = 0.003;    ///< s
  double endJitter = 0.008;      ///< s
  double amplitudeJitter = 0.3;  ///< share, of every amplitude relative to the first
  double mergeGap = 0.010;       ///< s; the object's
};

/// The events with their starts, ends and amplitudes jittered. Starts keep their order and stay a
/// merge gap apart; ends stay a merge gap before the next start, so that a listener's merge filter
/// would join nothing. What is then shorter than the merge gap is discrete (duration and centroid
/// 0). Times are rounded to 1 us, amplitudes to 1e-4. Empty for no events.
[[nodiscard]] ContactSignature listenTo(const std::vector<ContactEvent>& events,
                                        const ListenerSettings& settings, RandomStream& random);

/// The body grown by `factor` at the same density.
[[nodiscard]] Body scaledBody(Body body, double factor);

/// Largest rise of the body's energy (height above the ground plane) across an event or from one
/// event to the next, J; 0 when it only falls.
[[nodiscard]] double largestEnergyRise(const Body& body, const std::vector<ContactEvent>& events);

/// Positions in `values` of `count` samples whose mean is about `target`: the values are weighted
/// exponentially, which leaves the rest of their distribution as it is, and taken at even steps of
/// the weighted distribution. In ascending order. Where `target` is out of reach, the nearest end.
/// @param values  at least `count`
[[nodiscard]] std::vector<std::size_t> chooseByMean(const std::vector<double>& values,
                                                    std::size_t count, double target);

}  // namespace ifa
