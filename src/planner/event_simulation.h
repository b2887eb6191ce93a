// SPDX-License-Identifier: Apache-2.0
// Live simulation of one contact event, and of what leads to the next audible one.
#pragma once

#include <optional>
#include <vector>

#include "dynamics/stepper.h"
#include "model/contact_event.h"
#include "sampler/event_recorder.h"

namespace ifa {

/// Where a body that was left to itself is next heard.
struct NextContact {
  double delay = 0;            ///< s
  RigidState state;            ///< pre-contact state there
  bool silentContact = false;  ///< it touched on the way
};

/// Not thread safe; one per thread. The model must outlive it.
class EventSimulation {
 public:
  EventSimulation(const BodyModel& model, const RecorderSettings& recorder)
      : recorder_(recorder), stepper_(model) {}

  /// Ways in which the event that begins at `arrival` may end: the natural one first, then, where
  /// `cuts` is set, at each earlier impulse that is heard (what follows is then up to the caller).
  /// With `terminal`, the only way taken is that to rest without another audible event.
  /// Contacts less than `mergeGap` (s; 0: the recorder's) apart are one event.
  /// Empty when the contact is not heard at once. Times count from the arrival.
  void outcomes(const RigidState& arrival, double restitution, bool terminal, bool cuts,
                std::vector<ContactEvent>& out, double mergeGap = 0);

  /// Gaps from `state` to the next audible event, and from each to the one after it, start to
  /// start, as the body goes on when it is left to itself: at most `count`, and none that ends
  /// after `horizon` seconds. Fewer when it comes to rest.
  [[nodiscard]] std::vector<double> rhythm(const RigidState& state, std::size_t count,
                                           double horizon);

  /// Simulates from `state` for at most `horizon` seconds until an audible event begins.
  [[nodiscard]] std::optional<NextContact> nextAudible(const RigidState& state, double horizon);

  /// Pieces of motion simulated so far (flights, impacts, steps in contact): a measure of work.
  [[nodiscard]] long pieces() const { return pieces_; }

 private:
  Advance advance(EventRecorder& recorder);

  RecorderSettings recorder_;
  Stepper stepper_;
  long pieces_ = 0;
};

}  // namespace ifa
