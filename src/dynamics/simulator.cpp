// SPDX-License-Identifier: Apache-2.0
#include "dynamics/simulator.h"

#include "dynamics/stepper.h"

namespace ifa {

DropResult simulateDrop(const Body& body, const SurfaceProperties& surface, const RigidState& start,
                        double timeLimit) {
  const BodyModel model(body, surface);
  return simulateDrop(model, start, timeLimit);
}

DropResult simulateDrop(const BodyModel& model, const RigidState& start, double timeLimit) {
  Stepper stepper(model);
  stepper.start(kernelState(start, 0));
  DropResult result;
  while (stepper.state().time < timeLimit) {
    const Advance did = stepper.advance(timeLimit);
    if (did == Advance::kImpact || did == Advance::kContact) {
      result.steps.push_back(stepper.contactStep());
    }
    if (did == Advance::kRest) {
      result.atRest = true;
      break;
    }
  }
  result.restTime = stepper.state().time;
  result.rest = rigidState(stepper.state());
  return result;
}

}  // namespace ifa
