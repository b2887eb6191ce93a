// SPDX-License-Identifier: Apache-2.0
// Many simulations of one body side by side, as many at once as a register has lanes
// (docs/dynamics.md). Each gets the bits that Stepper gives it alone.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body_model.h"
#include "dynamics/kernel_state.h"
#include "dynamics/piece.h"

namespace ifa {

class BatchStepper;

/// Hears what happens in a batch: all of a simulation in order of its time, simulations in any
/// order.
class BatchListener {
 public:
  BatchListener() = default;
  BatchListener(const BatchListener&) = delete;
  BatchListener& operator=(const BatchListener&) = delete;
  virtual ~BatchListener() = default;

  /// One more piece in `place`. Returns whether the simulation goes on; it does not after kRest.
  /// May start another one in `place`, which then goes on.
  virtual bool hear(BatchStepper& batch, std::size_t place, const Piece& piece) = 0;
};

/// Not thread safe; make one per thread. The model must outlive it.
class BatchStepper {
 public:
  /// Simulations for which registers are full most of the time and a station, once at work, has
  /// enough for several times.
  static constexpr std::size_t kPlaces = 128;

  /// @param places  simulations at a time
  explicit BatchStepper(const BodyModel& body, std::size_t places = kPlaces);
  ~BatchStepper();
  BatchStepper(const BatchStepper&) = delete;
  BatchStepper& operator=(const BatchStepper&) = delete;

  [[nodiscard]] std::size_t places() const;
  /// Begins a simulation in a free place, as Stepper::start() does.
  void start(std::size_t place, const KernelState<double>& state);
  void start(std::size_t place, const KernelState<double>& state, double restitution);
  /// Goes on with all simulations until none does; no flight or step passes `limit` (s, of each
  /// simulation's own time).
  void run(double limit, BatchListener& listener);

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

/// Instruction sets for which the batch was compiled and that this processor has, best first.
[[nodiscard]] std::vector<std::string> instructionSets();
/// The one in use.
[[nodiscard]] std::string instructionSet();
/// Use this one from now on (one of instructionSets()); for tests and benchmarks. Results are the
/// same.
void useInstructionSet(const std::string& name);

}  // namespace ifa
