// SPDX-License-Identifier: Apache-2.0
// Branch and bound over the contact-event graph, with a horizon that moves on. IFA 5.5,
// docs/branch-and-bound.md.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "graph/contact_graph.h"
#include "planner/graph_planner_settings.h"
#include "planner/look_ahead.h"
#include "planner/orientation_wishes.h"
#include "planner/path_connector.h"
#include "planner/planner.h"
#include "planner/position_wishes.h"

namespace ifa {

/// One edge of a path: the flight that arrives at event sibling + 1.
struct GraphEdge {
  std::uint32_t sibling = 0;
  double time = 0;  ///< T*, s
  EdgeWeight weight;
  std::uint32_t symmetry = 0;  ///< Transition::symmetry
  double place = 0;            ///< log f_p where it arrives
};

/// A walk through the graph that meets the signature's first events.
struct GraphPath {
  std::uint32_t first = 0;
  double firstAmplitude = 1;  ///< N s
  LogScore sound;             ///< of the first event
  std::vector<GraphEdge> edges;

  [[nodiscard]] int last() const { return static_cast<int>(edges.size()); }
  /// Event that meets the signature's event `level`.
  [[nodiscard]] std::uint32_t event(int level) const {
    return level == 0 ? first : edges[static_cast<std::size_t>(level) - 1].sibling + 1;
  }
  /// Log of the product of all weights and f_p, and of the first event's sound.
  [[nodiscard]] double total() const;
};

/// Finds complete paths, each from another start. Signatures of two events or more. Not thread
/// safe; request, graph and connector must outlive it.
class GraphSearch {
 public:
  /// @param stop  asked before each node is expanded; ends the search
  GraphSearch(const PlanRequest& request, const GraphPlannerSettings& settings,
              PathConnector& connector, std::function<bool()> stop);

  /// The next complete path, all of whose connections are made; none when there is no other, or
  /// the search was stopped, or its budget is spent.
  [[nodiscard]] std::optional<GraphPath> next();
  /// The longest path whose connections are made, for when there is no complete one.
  [[nodiscard]] const GraphPath& farthest() const { return farthest_; }
  /// Looks on from there, whatever `stop` says, with a tenth of what was spent: no path may have
  /// led to the horizon, and how far one leads says which contact is the one to blame.
  void reachFarthest();
  [[nodiscard]] long queries() const { return queries_; }
  /// Tells how much of the signature the path that is being made has met, 0 to 1.
  std::function<void(double)> progress;

 private:
  /// Level, event before the edge, sibling: an edge that has no flight.
  using Edge = std::tuple<int, std::uint32_t, std::uint32_t>;
  /// First event, level, event before, sibling by which it reached the next one, sibling: an edge
  /// that must not follow another one.
  using Turn = std::tuple<std::uint32_t, int, std::uint32_t, std::uint32_t, std::uint32_t>;

  /// What was found when so many were wanted.
  struct Children {
    std::size_t wanted = 0;
    std::vector<GraphChild> found;

    [[nodiscard]] bool servesFor(std::size_t more) const {
      return more <= wanted || found.size() < wanted;
    }
  };

  /// Where a path's last event lies in the frame of its first.
  struct Standing {
    Placement placement;
    Registered registered;
  };

  [[nodiscard]] int levels() const;
  [[nodiscard]] bool spent() const;
  [[nodiscard]] std::optional<GraphPath> bestFrom(const GraphPath& kept, int depth);
  [[nodiscard]] int depthFrom(const GraphPath& kept) const;
  void descend(GraphPath& path, int depth, double total);
  void descendFromStarts(int depth);
  [[nodiscard]] static Turn turn(const GraphPath& path, int level, std::uint32_t sibling);
  [[nodiscard]] bool banned(const GraphPath& path, std::uint32_t sibling) const;
  [[nodiscard]] const std::vector<GraphChild>& children(const GraphPath& path);
  [[nodiscard]] std::vector<GraphChild> find(const GraphPath& path, std::size_t wanted);
  [[nodiscard]] Standing standing(const GraphPath& path);
  [[nodiscard]] double placeOf(const Standing& from, int level, std::uint32_t event,
                               std::uint32_t sibling, std::uint32_t symmetry);
  [[nodiscard]] bool lies(int level, std::uint32_t event) const;
  [[nodiscard]] bool ownWayLies(int level, std::uint32_t event) const;
  [[nodiscard]] double timeAfter(const GraphPath& path) const;
  [[nodiscard]] bool allConnect(const GraphPath& path);
  [[nodiscard]] bool connects(const GraphPath& path, int level);
  bool stepBack(GraphPath& kept);
  void newStart();

  const PlanRequest& request_;
  GraphPlannerSettings settings_;
  PathConnector& connector_;
  const ContactGraph& graph_;
  LookAhead lookAhead_;
  OrientationWishes wishes_;
  PositionWishes places_;
  std::function<bool()> stop_;
  std::vector<PathStart> starts_;
  std::set<std::uint32_t> usedStarts_;
  std::set<Edge> noFlight_;
  std::set<Turn> noTurn_;
  std::map<std::tuple<int, std::uint32_t>, std::size_t> bans_;  ///< on the way out of an event
  std::map<std::tuple<std::uint32_t, int, std::uint32_t>, Children> children_;
  std::vector<GraphChild> placed_;  ///< children whose worth depends on the way there
  std::optional<GraphPath> best_;
  double bestTotal_ = 0;
  GraphPath farthest_;
  long queries_ = 0, mostQueries_;
  int deadEnds_ = 0;         ///< from this start
  std::vector<int> deadAt_;  ///< the same, by level
  bool stopped_ = false;
};

}  // namespace ifa
