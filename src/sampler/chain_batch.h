// SPDX-License-Identifier: Apache-2.0
// Chains of contact events of many simulations at a time. docs/sampling.md.
#pragma once

#include <vector>

#include "dynamics/batch_stepper.h"
#include "sampler/event_chain.h"

namespace ifa {

/// Simulates what EventChain does, bit for bit, side by side in a BatchStepper: whenever a link
/// ends, the next one starts in its place, and after the last one the next simulation. Not thread
/// safe; one per thread. The model must outlive it.
class ChainBatch : private BatchListener {
 public:
  /// Simulations at a time, of the some hundreds of a block: of more, places are empty for longer
  /// at its end.
  static constexpr std::size_t kPlaces = 64;

  ChainBatch(const BodyModel& model, const RecorderSettings& recorder,
             std::size_t places = kPlaces);

  /// The events of a simulation from each of `starts` to rest, at most `timeLimit` seconds (of the
  /// simulation's own time) each, in the order of the starts.
  [[nodiscard]] std::vector<std::vector<EventRecord>> simulate(
      const std::vector<RigidState>& starts, double timeLimit);

 private:
  struct Place {
    explicit Place(const RecorderSettings& recorder) : listener(recorder) {}
    LinkListener listener;
    ChainWriter writer;
  };

  bool hear(BatchStepper& batch, std::size_t place, const Piece& piece) override;
  bool startLink(std::size_t place);
  bool startNext(std::size_t place);

  BatchStepper batch_;
  std::vector<Place> places_;
  const std::vector<RigidState>* starts_ = nullptr;
  std::vector<std::vector<EventRecord>> records_;
  std::size_t next_ = 0;  ///< the first start that waits
  double timeLimit_ = 0;
};

}  // namespace ifa
