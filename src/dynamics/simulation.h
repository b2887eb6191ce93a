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

/// One number after the other, whole ones too, in blocks of eight that are moved together.
template <class R>
struct Simulation {
  static constexpr int kMaxPoints = ContactSolver<R>::kMaxPoints;

  KernelState<R> state{};
  R kinetic{};     ///< energy of `state`, J; what spendGain() left of it
  R quietSince{};  ///< s; negative: it moves
  // The third block.
  R impactsHere{}, stuck{};  ///< impacts at this instant; lifts in a row without a step
  R restitution{};           ///< of this run
  R step{}, cuts{};          ///< a step that is tried again, s (0: none), and how often it was
  R lastStep{};              ///< of the step before, s; 0: none
  R lastCount{};             ///< points of the step before
  R unused{};
  // The fourth block and, with two points in each, others.
  Vec<R> lastMoment{};  ///< of the step before, N m s
  R unusedToo{};
  LastPoint<R> last[kMaxPoints]{};
  LastPoint<R> unusedPoint{};

  /// Blocks that matter when there are `points` points of the step before.
  static constexpr std::size_t blocks(std::size_t points) { return 4 + points / 2; }
  /// Blocks without what only the next step in contact asks for.
  static constexpr std::size_t kBlocksWithout = 3;

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
