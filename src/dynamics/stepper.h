// SPDX-License-Identifier: Apache-2.0
// The kernel: one body, flight and contact in turn (docs/dynamics.md). Sampler, planner and replay
// all step with this one class, so the same start gives the same bits to each.
#pragma once

#include <array>
#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/contact_solver.h"
#include "dynamics/flight.h"
#include "dynamics/ground_watch.h"
#include "dynamics/kernel_state.h"
#include "model/contact_step.h"

namespace ifa {

/// What one call of Stepper::advance did.
enum class Advance {
  kFlight,   ///< flew one segment; nothing touched
  kTouch,    ///< flew to a touch
  kImpact,   ///< an impact: no time passed
  kContact,  ///< a step in contact
  kLift,     ///< left the ground: no time passed
  kRest      ///< at rest
};

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

  [[nodiscard]] const KernelState<double>& state() const { return state_; }
  /// After kImpact and kContact: the state before, and the sum of impulses over all points, N s.
  [[nodiscard]] const KernelState<double>& before() const { return before_; }
  [[nodiscard]] const Vec<double>& impulse() const { return impulse_; }
  /// A vertex is at the ground and does not part from it.
  [[nodiscard]] bool touching() const;
  [[nodiscard]] ContactStep contactStep() const;

 private:
  using Solver = ContactSolver<double>;

  void look();
  Advance fly(double limit);
  Advance touch(double limit);
  Advance impact();
  Advance contact(double limit);
  Advance lift();
  void gatherHits();
  void gatherHeld(double step);
  void addPoints();
  void warmStart(double step);
  bool solveStep(double step);
  void keep(double step);
  bool halve(double step, double energy0);
  Advance finish();
  /// Hull vertex of point `k` of solver_.
  [[nodiscard]] int vertexOf(int k) const {
    return watch_.vertex(chosen_[static_cast<std::size_t>(k)]);
  }
  [[nodiscard]] double overshoot(double step) const;
  [[nodiscard]] bool settled();

  const BodyModel& body_;
  double restitution_;
  Phase phase_ = Phase::kFlight;
  KernelState<double> state_, before_;
  KernelState<double> middle_, end_;  ///< of a long step
  Rotation<double> rotation_;         ///< of state_, when seen_
  GroundWatch watch_;
  GroundFrame now_, next_;  ///< of state_, when seen_; of the step's end
  bool seen_ = false;
  std::vector<std::size_t> chosen_;  ///< numbers in watch_'s list
  Solver solver_;
  struct HeldVertex {
    int vertex;
    Vec<double> impulse;
  };
  std::array<HeldVertex, Solver::kMaxPoints> last_;  ///< points of the step before
  Vec<double> impulse_{}, lastMoment_{};
  double kinetic_ = 0;  ///< J, of state_, when seen_
  int lastCount_ = 0;
  double lastStep_ = 0;
  double quietSince_ = -1;
  int impactsHere_ = 0, stuck_ = 0;
};

}  // namespace ifa
