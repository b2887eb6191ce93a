// SPDX-License-Identifier: Apache-2.0
#include "dynamics/stepper.h"

#include "dynamics/energy.h"

namespace ifa {

Stepper::Stepper(const BodyModel& body)
    : body_(body), rotation_(Quat<double>{1, 0, 0, 0}), ground_(body), contact_(body) {}

void Stepper::start(const KernelState<double>& state) { start(state, body_.surface.restitution); }

void Stepper::start(const KernelState<double>& state, double restitution) {
  sim_.begin(state, restitution);
  before_ = state;
  phase_ = Phase::kContact;  // contact() lifts off at once when nothing is near
  seen_ = false;
}

Advance Stepper::advance(double limit) {
  switch (phase_) {
    case Phase::kFlight:
      return fly(limit);
    case Phase::kContact:
      return touch(limit);
    case Phase::kHalfway:
      before_ = sim_.state;
      sim_.state = end_;
      return finish();
    case Phase::kRest:
      break;
  }
  return Advance::kRest;
}

Advance Stepper::fly(double limit) {
  seen_ = false;
  if (!flyOn(body_, limit, sim_)) return Advance::kFlight;
  phase_ = Phase::kContact;
  return Advance::kTouch;
}

/// Measures the vertices that a step from here can bring to the ground.
void Stepper::look() {
  const KernelState<double>& state = sim_.state;
  if (!seen_) {
    rotation_ = Rotation<double>(state.q);
    sim_.kinetic = kineticEnergy(body_, state.velocity, state.w);
  }
  const bool remade = ground_.cover(state.position.z, rotation_.rows[2], sim_.kinetic);
  if (!seen_ || remade) ground_.measure(state, rotation_);
  seen_ = true;
}

Advance Stepper::touch(double limit) {
  look();
  return contact_.hits(sim_, ground_) ? impact() : contact(limit);
}

Advance Stepper::impact() {
  before_ = sim_.state;
  contact_.impact(sim_, rotation_, ground_);
  impulse_ = contact_.impulse();
  return Advance::kImpact;
}

Advance Stepper::lift() {
  phase_ = sim_.stuck > ContactRules::kLiftsToRest ? Phase::kRest : Phase::kFlight;
  return Advance::kLift;
}

Advance Stepper::contact(double limit) {
  before_ = sim_.state;
  contact_.tryStep(limit, sim_, rotation_, ground_);
  while (contact_.triesAgain()) {
    rotation_ = Rotation<double>(before_.q);
    contact_.tryStep(limit, sim_, rotation_, ground_);
  }
  if (contact_.lifts()) return lift();
  ground_.goOn();
  impulse_ = contact_.impulse();
  if (!contact_.halves()) return finish();
  end_ = sim_.state;
  sim_.state = contact_.middle();
  phase_ = Phase::kHalfway;
  return Advance::kContact;
}

Advance Stepper::finish() {
  phase_ = contact_.rests() ? Phase::kRest : Phase::kContact;
  return Advance::kContact;
}

bool Stepper::touching() const { return phase_ != Phase::kFlight && contact_.touches(ground_); }

}  // namespace ifa
