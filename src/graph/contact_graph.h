// SPDX-License-Identifier: Apache-2.0
// The contact-event graph: an event database with its transitions, found when they are asked for.
// IFA 5.2, 5.4 and 5.5, docs/neighbours.md.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "body/symmetry.h"
#include "connection/placement.h"
#include "database/database.h"
#include "graph/edge_weight.h"
#include "ifa/result.h"
#include "model/contact_event.h"

namespace ifa {

class EventTree;

/// An edge: the body leaves the source as event `sibling` was left, and comes to `event()`.
struct Transition {
  std::uint32_t sibling = 0;  ///< event j of the database, most like the source
  EdgeWeight weight;
  double total = 0;  ///< weight.total()
  /// Element of the body's symmetry group whose image of j, and of what followed it, is meant: of
  /// all the one that weighs most.
  std::uint32_t symmetry = 0;

  /// The event that the edge leads to, k = j + 1.
  [[nodiscard]] std::uint32_t event() const { return sibling + 1; }
};

/// First edge of a path: event `first` of the database and the one after it, as simulated but for
/// the time of the way between.
struct PathStart {
  std::uint32_t first = 0;
  double time = 0;    ///< T* between the two, s
  LogScore sound;     ///< of the first event; f_v = f_q = f_t = 1
  EdgeWeight weight;  ///< of the edge to the second, with the first as source and sibling
  double total = 0;   ///< sound.total() + weight.total()

  [[nodiscard]] std::uint32_t second() const { return first + 1; }
};

/// A path of one event: a terminal event.
struct PathEnd {
  std::uint32_t event = 0;
  double total = 0;  ///< log f_l + log f_c; f_a = 1, the event is its own measure
};

/// Read only, thread safe, moved and not copied. Keeps the database mapped and 64 bytes an event
/// besides. Results are the same for any number of threads.
class ContactGraph {
 public:
  /// Builds the two search trees (terminal events and all others) on the worker threads
  /// (setThreadCount), at most about a second per million events. Reports as "index". Errors:
  /// kBadInput for a database of another body or one with more than 2^32 - 1 events, kInterrupted.
  [[nodiscard]] static Result<ContactGraph> make(EventDatabase database, const Body& body,
                                                 const GraphSettings& settings = {},
                                                 const Progress& progress = {});
  ContactGraph(ContactGraph&&) noexcept;
  ContactGraph& operator=(ContactGraph&&) noexcept;
  ~ContactGraph();

  /// The `count` best edges by total(), best first, equal ones by sibling. By tree: now and then
  /// one is missed (docs/neighbours.md). Fewer, or none, where there are no more.
  [[nodiscard]] std::vector<Transition> best(const TransitionSource& source,
                                             const TransitionTarget& target,
                                             std::size_t count) const;
  /// The same by looking at every event: the oracle. Seconds for millions of events.
  [[nodiscard]] std::vector<Transition> bestByScan(const TransitionSource& source,
                                                   const TransitionTarget& target,
                                                   std::size_t count) const;
  /// Weight of the edge to sibling + 1. @param sibling  under database().events()
  /// @param symmetry  element of the group whose image of the sibling is meant; 0: itself
  [[nodiscard]] EdgeWeight edgeWeight(const TransitionSource& source,
                                      const TransitionTarget& target, std::uint32_t sibling,
                                      std::size_t symmetry = 0) const;

  /// Weight of the edge that follows `event` through silent contact, as it was simulated.
  [[nodiscard]] EdgeWeight silentWeight(const TransitionTarget& target, std::uint32_t event) const;

  /// First edges of a path of two events or more (5.5), best first by total, equal ones by event;
  /// exact. T* is `time` less the first event's own duration; the first event's amplitude is what
  /// amplitudes are over, so `second.time` and `second.firstAmplitude` are not read. Some 100 ms
  /// for millions of events.
  /// @param time   from the first event's start to the second's, s
  /// @param first  heard; its amplitude is 1 by definition and not read
  [[nodiscard]] std::vector<PathStart> bestStarts(double time, const HeardEvent& first,
                                                  const TransitionTarget& second,
                                                  std::size_t count) const;
  /// Events, terminal or not, for a signature of one event, best first, equal ones by event.
  [[nodiscard]] std::vector<PathEnd> bestAlone(const HeardEvent& heard, bool terminal,
                                               std::size_t count) const;

  /// Event of the database, its pre-contact state over the origin at time 0.
  [[nodiscard]] ContactEvent event(std::uint32_t event) const;
  /// `sibling` and the event after it, in one world frame and on one clock, as the database has
  /// them. Only where EventRecord::kFollowed is set.
  [[nodiscard]] std::pair<ContactEvent, ContactEvent> passage(std::uint32_t sibling) const;
  /// As equations 6 to 8 see it. @param firstAmplitude  N s
  [[nodiscard]] HeardEvent heard(std::uint32_t event, double firstAmplitude) const;

  [[nodiscard]] const EventDatabase& database() const;
  [[nodiscard]] const GraphSettings& settings() const;
  /// The group that events are matched under; C1 where that is turned off.
  [[nodiscard]] const SymmetryGroup& symmetry() const;
  /// How an event is seen as its image under an element of that group.
  [[nodiscard]] const SymmetryImage& image(std::size_t element) const;
  /// Bytes kept besides the mapped database.
  [[nodiscard]] std::size_t indexBytes() const;
  /// The tree of the flights to terminal events, or that of all others: to measure.
  [[nodiscard]] const EventTree& tree(bool terminal) const;

 private:
  struct Parts;
  explicit ContactGraph(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace ifa
