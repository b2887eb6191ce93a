// SPDX-License-Identifier: Apache-2.0
#include "connection/ground_clearance.h"

#include "dynamics/flight.h"
#include "dynamics/kernel_state.h"

namespace ifa {

std::optional<double> goesUnder(const BodyModel& model, const RigidState& departure,
                                double duration, double depth) {
  KernelState<double> state = kernelState(departure, 0);
  state.position.z += depth;
  while (state.time < duration) {
    const FlightSegment segment(model, state, duration - state.time);
    const double hit = segment.firstTouch();
    if (hit <= segment.length()) return state.time + hit;
    state = segment.at(segment.length());
  }
  return std::nullopt;
}

}  // namespace ifa
