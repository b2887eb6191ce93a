// SPDX-License-Identifier: Apache-2.0
// Weight of an edge of the contact-event graph: the one place where equations 1 to 11 are put
// together. IFA 5.4, docs/method.md 4.
#pragma once

#include <cstdint>
#include <span>

#include "affinity/factors.h"
#include "body/body.h"
#include "database/database.h"
#include "graph/graph_settings.h"
#include "model/rigid_state.h"

namespace ifa {

/// The contact that is left: pre-contact and post-contact state, in any world frame (motions of the
/// plane change no weight).
struct TransitionSource {
  RigidState before, after;
};

/// What is to be met next.
struct TransitionTarget {
  double time = 0;   ///< T*: from the end of the source's event to the start of the next, s, > 0
  HeardEvent heard;  ///< as equations 6 to 8 see it: amplitude relative to the plan's first event
  bool terminal = false;      ///< the last one, after which the body rests
  double firstAmplitude = 1;  ///< of the plan's first event, N s, > 0: what amplitudes are over
};

/// Why there is no edge.
enum class EdgeRefusal : std::uint8_t {
  kNone,
  kNotFlight,    ///< no event follows the sibling, or not by such a way
  kEnd,          ///< f_end: just one of target and event is terminal
  kTime,         ///< a time is not above 0, or T_j is too far from T* to be warped
  kRising,       ///< the body would arrive on its way up, which it did not when simulated
  kEnergy,       ///< f_E: it would leave with more energy than it came with
  kVelocity,     ///< log f_v too low
  kOrientation,  ///< log f_q too low
  kTooLow,       ///< under what was asked for
};

/// Natural logarithms of the factors of an edge; 0 is perfect. What comes after a refusal, in the
/// order of EdgeRefusal, may not be set.
struct EdgeWeight {
  double velocity = 0;     ///< f_v, eq. 3
  double orientation = 0;  ///< f_q, eq. 4
  double timeWarp = 0;     ///< f_t, eq. 5
  double amplitude = 0;    ///< f_a, eq. 6
  double duration = 0;     ///< f_l, eq. 7
  double centroid = 0;     ///< f_c, eq. 8
  EdgeRefusal refusal = EdgeRefusal::kNone;

  [[nodiscard]] bool exists() const { return refusal == EdgeRefusal::kNone; }
  /// Of w, eq. 1.
  [[nodiscard]] double total() const {
    return velocity + orientation + timeWarp + amplitude + duration + centroid;
  }
  /// The same as equations 12 and 13 add it up.
  [[nodiscard]] LogScore score() const {
    return {amplitude + duration + centroid, velocity + orientation + timeWarp, velocity};
  }
};

/// Whether what follows `event` is another one, and flight all the way there.
/// @param flags  of all events of the database
[[nodiscard]] bool isLeftByFlight(std::span<const std::uint8_t> flags, std::size_t event);

/// Whether another one follows, and the body touches the ground on the way there.
[[nodiscard]] bool isLeftInSilence(std::span<const std::uint8_t> flags, std::size_t event);

/// Of the edge that follows `event` through silent contact to the next one, just as it was
/// simulated, shown in the time that is wanted (5.3.2): f_v = f_q = 1.
[[nodiscard]] EdgeWeight silentWeight(const EventDatabase& database, const GraphSettings& settings,
                                      const TransitionTarget& target, std::size_t event);

/// An event as equations 6 to 8 see it: duration filtered by the merge gap that the database was
/// made with. @param firstAmplitude  N s
[[nodiscard]] HeardEvent heardEvent(const EventDatabase& database, std::size_t event,
                                    double firstAmplitude);

/// Weighs the edges of one source to one target; made once for many siblings. Double precision,
/// the same bits everywhere. Keeps references to what it is made of. Thread safe.
class EdgeWeigher {
 public:
  EdgeWeigher(const EventDatabase& database, const Body& body, const GraphSettings& settings,
              const TransitionSource& source, const TransitionTarget& target);

  /// @param sibling  event j, under the database's events()
  [[nodiscard]] EdgeWeight weigh(std::size_t sibling) const;
  /// The same, cut short (and kTooLow) where total() cannot reach `least`.
  [[nodiscard]] EdgeWeight weigh(std::size_t sibling, double least) const;

 private:
  [[nodiscard]] EdgeRefusal refusedUnseen(std::size_t sibling) const;
  void weighMotion(const EventRecord& j, const EventRecord& k, EdgeWeight& weight) const;

  const EventDatabase* database_;
  const Body* body_;
  const GraphSettings* settings_;
  const TransitionSource* source_;
  const TransitionTarget* target_;
  PlausibleRegion region_;
  double energy_;  ///< that the body may leave with, J
};

}  // namespace ifa
