// SPDX-License-Identifier: Apache-2.0
#include "sampler/chain_batch.h"

#include <utility>

namespace ifa {

ChainBatch::ChainBatch(const BodyModel& model, const RecorderSettings& recorder, std::size_t places)
    : batch_(model, places), places_(places, Place(recorder)) {}

std::vector<std::vector<EventRecord>> ChainBatch::simulate(const std::vector<RigidState>& starts,
                                                           double timeLimit) {
  starts_ = &starts;
  records_.assign(starts.size(), {});
  next_ = 0;
  timeLimit_ = timeLimit;
  for (std::size_t place = 0; place < places_.size(); ++place) startNext(place);
  batch_.run(Stepper::kNoLimit, *this);
  return std::exchange(records_, {});
}

bool ChainBatch::hear(BatchStepper&, std::size_t place, const Piece& piece) {
  LinkListener& listener = places_[place].listener;
  listener.hear(piece);
  if (listener.goesOn()) return true;
  places_[place].writer.add(listener.link());
  return startLink(place) || startNext(place);
}

/// Starts the next link of the simulation in `place`. False when it has none.
bool ChainBatch::startLink(std::size_t place) {
  Place& here = places_[place];
  if (!here.writer.goesOn()) return false;
  batch_.start(place, here.listener.begin(here.writer.state(), here.writer.timeLeft()));
  return true;
}

/// Starts the next simulation in `place`. False when there are no more.
bool ChainBatch::startNext(std::size_t place) {
  while (next_ < starts_->size()) {
    const std::size_t number = next_++;
    places_[place].writer.begin((*starts_)[number], timeLimit_, records_[number]);
    if (startLink(place)) return true;
  }
  return false;
}

}  // namespace ifa
