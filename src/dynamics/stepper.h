// SPDX-License-Identifier: Apache-2.0
// The kernel: one body, flight and contact in turn (docs/dynamics.md). Sampler, planner and replay
// all step with this one class, so the same start gives the same bits to each.
#pragma once

#include "dynamics/body_model.h"
#include "dynamics/contact_phase.h"
#include "dynamics/flight.h"
#include "dynamics/ground_watch.h"
#include "dynamics/kernel_state.h"
#include "dynamics/piece.h"
#include "dynamics/simulation.h"

namespace ifa {

/// Not thread safe; make one per thread. The model must outlive it.
class Stepper {
 public:
  /// A limit that never binds. A limit that does shortens a segment or a step, and so changes the
  /// last bits: whoever wants the same bits again uses this and looks at the time.
  static constexpr double kNoLimit = 1e9;

  explicit Stepper(const BodyModel& body);

  /// Begins anew from `state`, with no memory of earlier contacts.
  void start(const KernelState<double>& state);
  /// As start(), with a restitution of its own for this run.
  void start(const KernelState<double>& state, double restitution);
  /// Does the next piece of motion; no flight or step passes `limit` (s).
  Advance advance(double limit);

  [[nodiscard]] const KernelState<double>& state() const { return sim_.state; }
  /// After kImpact and kContact: the state before, and the sum of impulses over all points, N s.
  [[nodiscard]] const KernelState<double>& before() const { return before_; }
  [[nodiscard]] const Vec<double>& impulse() const { return impulse_; }
  /// A vertex is at the ground and does not part from it.
  [[nodiscard]] bool touching() const;
  [[nodiscard]] ContactStep contactStep() const { return piece(Advance::kContact).contactStep(); }
  /// What advance() did, for those who hear batches too. Good until the next call of it.
  [[nodiscard]] Piece piece(Advance did) const {
    const bool contact = did == Advance::kImpact || did == Advance::kContact;
    return {did, before_, sim_.state, impulse_, contact && touching()};
  }

 private:
  /// Where the simulation is.
  enum class Phase {
    kFlight,
    kContact,
    kHalfway,  ///< in the middle of a long step in contact, whose end is known
    kRest
  };

  void look();
  Advance fly(double limit);
  Advance touch(double limit);
  Advance impact();
  Advance contact(double limit);
  Advance lift();
  Advance finish();

  const BodyModel& body_;
  Phase phase_ = Phase::kFlight;
  Simulation<double> sim_;
  KernelState<double> before_, end_;  ///< end_: of a long step, while halfway
  Rotation<double> rotation_;         ///< of the state, when seen_
  GroundWatch ground_;                ///< likewise
  ContactPhase<double, GroundWatch> contact_;
  Vec<double> impulse_{};
  bool seen_ = false;
};

}  // namespace ifa
