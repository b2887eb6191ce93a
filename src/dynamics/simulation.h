// SPDX-License-Identifier: Apache-2.0
// All that one simulation keeps from one piece of motion to the next.
#ifndef IFA_DYNAMICS_SIMULATION_H
#define IFA_DYNAMICS_SIMULATION_H

#include "dynamics/contact_solver.h"
#include "dynamics/lane_state.h"

namespace ifa {

/// A point of the step before.
template <class R>
struct LastPoint {
  R vertex{};        ///< of the hull
  Vec<R> impulse{};  ///< N s
};

/// One number after the other, whole ones too, so that lanes are filled from rows of them.
template <class R>
struct Simulation {
  static constexpr int kMaxPoints = ContactSolver<R>::kMaxPoints;

  KernelState<R> state{};
  R kinetic{};                 ///< energy of `state`, J; what spendGain() left of it
  R restitution{};             ///< of this run
  R impactsHere{}, stuck{};    ///< impacts at this instant; lifts in a row without a step
  R quietSince{};              ///< s; negative: it moves
  R step{}, cuts{};            ///< a step that is tried again, s (0: none), and how often it was
  R lastStep{};                ///< of the step before, s; 0: none
  R lastCount{};               ///< points of the step before ...
  Vec<R> lastMoment{};      ///< ... its moments ...
  LastPoint<R> last[kMaxPoints]{};  ///< ... and themselves

  /// Starts anew, with no memory of earlier contacts. The kinetic energy is for others to say.
  void begin(const KernelState<R>& from, const R& bounce) {
    state = from;
    restitution = bounce;
    impactsHere = stuck = step = cuts = lastStep = lastCount = R(0.0);
    quietSince = R(-1.0);
  }
};

}  // namespace ifa

#endif
