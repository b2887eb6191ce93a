// SPDX-License-Identifier: Apache-2.0
#include "planner/contact_beginning.h"

#include <algorithm>

#include "dynamics/energy.h"
#include "dynamics/stepper.h"

namespace ifa {

namespace {
constexpr double kBin = 1e-3;  // s, in which impulses are heard (docs/method.md, 2)
}

ContactBeginning beginningOf(const BodyModel& model, const RigidState& before, double restitution,
                             double end) {
  Stepper stepper(model);
  stepper.start(kernelState(before, 0), restitution);
  const double until = std::min(kBin, end);
  ContactBeginning beginning;
  for (bool touched = false;;) {
    const Advance did = stepper.advance(Stepper::kNoLimit);
    const bool touches = did == Advance::kImpact || did == Advance::kContact;
    const Vec<double>& v = stepper.state().velocity;
    if (touches || did == Advance::kRest) {
      beginning.afterBin = {v.x, v.y, v.z};
      beginning.time = stepper.state().time;
      if (!touched) {
        beginning.first = beginning.afterBin;
        beginning.energy = totalEnergy(model, stepper.state());
      }
      touched = true;
    }
    if (did == Advance::kRest || (touched && stepper.state().time >= until)) return beginning;
  }
}

bool canBegin(const BodyModel& model, const RecorderSettings& recorder,
              const ContactBeginning& beginning, double arrivalEnergy,
              const Eigen::Vector3d& arrivalVelocity, double depth) {
  const double rounding = model.mass * kGravity * depth;
  if (beginning.energy - arrivalEnergy > rounding) return false;
  const Eigen::Vector3d fallen(0, 0, kGravity * beginning.time);
  const double impulse =
      model.mass * std::max((beginning.first - arrivalVelocity).norm(),
                            (beginning.afterBin + fallen - arrivalVelocity).norm());
  return recorder.counts(recorder.excess(impulse, kBin));
}

}  // namespace ifa
