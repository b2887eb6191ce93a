// SPDX-License-Identifier: Apache-2.0
// The connections of a path through the contact-event graph, made when they are asked for (lazy
// blends, IFA 5.5), with the events that they join simulated again.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>

#include "connection/connection.h"
#include "graph/contact_graph.h"
#include "planner/planner.h"
#include "sampler/event_chain.h"

namespace ifa {

/// An edge whose flight, or silent passage, was made: everything in the frame of the event that is
/// left, or of the one that is reached.
struct ConnectedEdge {
  bool feasible = false;
  bool silent = false;         ///< followed through silent contact, as simulated
  Connection connection;       ///< in the frame of the event that is left
  Placement placement;         ///< lays the reached event's frame into it
  RigidState arrival;          ///< in the reached event's frame
  double bend = 0;             ///< leaving
  double arrivalBend = 0;      ///< reaching
  double departureEnergy = 0;  ///< J
  double arrivalEnergy = 0;    ///< J, the same but for rounding
  double logVelocity = 0;      ///< f_v of the flight that was made
  double logOrientation = 0;   ///< f_q, likewise
  double logTimeWarp = 0;      ///< f_t, likewise
};

/// Keeps what it has made. Not thread safe; one per search. The request and its graph must outlive
/// it.
class PathConnector {
 public:
  explicit PathConnector(const PlanRequest& request);

  /// Event `id` of the database, simulated again: in its own frame, from time 0, to the bit as its
  /// replay.
  [[nodiscard]] const ContactEvent& event(std::uint32_t id) { return link(id).event; }
  /// Lays the frame of sibling + 1, of its image under element `symmetry`, into that of event
  /// `from`; for an edge that has a flight or not.
  [[nodiscard]] Placement placement(std::uint32_t from, std::uint32_t sibling,
                                    std::uint32_t symmetry);
  /// The edge from event `from` to the image of sibling + 1 under element `symmetry`, whose flight
  /// takes `time` seconds (T*).
  /// @param level  index of the signature's event that `from` meets: it fixes the time
  [[nodiscard]] const ConnectedEdge& edge(int level, std::uint32_t from, std::uint32_t sibling,
                                          std::uint32_t symmetry, double time);
  /// Eq. 10 as it is seen: the body leaves by `next` with no more energy than it came with.
  /// @param previous  the edge that it came by; null for the first event
  [[nodiscard]] bool energyAllows(std::uint32_t event, const ConnectedEdge* previous,
                                  const ConnectedEdge& next);
  [[nodiscard]] const BodyModel& model() const { return model_; }
  [[nodiscard]] PlausibleRegion regionOf(std::uint32_t event);

 private:
  /// Event `id`, and how its simulation goes on.
  [[nodiscard]] const ChainLink& link(std::uint32_t id);
  [[nodiscard]] bool isSilent(std::uint32_t from, std::uint32_t sibling) const;
  [[nodiscard]] ConnectedEdge makeSilent(std::uint32_t from, double time);
  [[nodiscard]] ConnectedEdge make(std::uint32_t from, std::uint32_t sibling,
                                   std::uint32_t symmetry, double time);
  void weigh(std::uint32_t from, std::uint32_t sibling, double time, ConnectedEdge& edge);
  [[nodiscard]] bool reachable(std::uint32_t id, const ConnectedEdge& edge);

  const ContactGraph& graph_;
  BodyModel model_;
  RecorderSettings recorder_;
  EventChain chain_;
  ConnectionSettings connection_;
  std::unordered_map<std::uint32_t, ChainLink> links_;
  std::map<std::tuple<int, std::uint32_t, std::uint32_t, std::uint32_t>, ConnectedEdge> edges_;
};

}  // namespace ifa
