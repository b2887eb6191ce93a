// SPDX-License-Identifier: Apache-2.0
#include "sampler/simulator_comparison.h"

namespace ifa {

SimulatorComparison compareWithOde(const Body& body, SurfaceProperties surface,
                                   const ComparisonSettings& settings) {
  const BodyModel model(body, surface);
  const auto native = [&](const RigidState& start) {
    return simulateDrop(model, start, settings.timeLimit);
  };
  const auto ode = [&](const RigidState& start) {
    return simulateDropOde(body, surface, start, settings.timeLimit, settings.ode);
  };
  const auto gather = [&](const Simulate& simulate) {
    return gatherStatistics(body, surface, simulate, settings.seed, settings.drops);
  };
  if (surface.referenceImpulse <= 0)
    surface.referenceImpulse = median(gather(native).largestImpulse);
  SimulatorComparison result{gather(native), gather(ode)};
  result.eventCounts = distributionDistance(result.native.audibleEvents, result.ode.audibleEvents);
  result.restTimes = distributionDistance(result.native.restTimes, result.ode.restTimes);
  result.gaps = distributionDistance(result.native.gaps, result.ode.gaps);
  return result;
}

}  // namespace ifa
