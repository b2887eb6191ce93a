// SPDX-License-Identifier: Apache-2.0
#include "planner/graph_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ifa {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();
/// Lists of children that are kept; then they are looked for again.
constexpr std::size_t kMostLists = 200000;
/// Times the children wanted that are looked at where few can go on.
constexpr std::size_t kMostAhead = 512;
/// Times the starts wanted that are looked at where few lie as asked.
constexpr std::size_t kMoreStarts = 4;
/// Log weight that an event is put back by whose own way leads to one that lies otherwise.
constexpr double kLiesOtherwise = 10;

}  // namespace

double GraphPath::total() const {
  double sum = sound.total();
  for (const GraphEdge& edge : edges) sum += edge.weight.total() + edge.place;
  return sum;
}

GraphSearch::GraphSearch(const PlanRequest& request, const GraphPlannerSettings& settings,
                         PathConnector& connector, std::function<bool()> stop)
    : request_(request),
      settings_(settings),
      connector_(connector),
      graph_(*request.graph),
      lookAhead_(request, connector.model()),
      wishes_(request),
      places_(request),
      stop_(std::move(stop)),
      mostQueries_(
          static_cast<long>(static_cast<double>(settings.mostQueries) * request.settings.effort)) {
  const auto& events = request.signature.events;
  TransitionTarget second;
  second.heard = heardOf(events[1]);
  second.terminal = events.size() == 2 && request.signature.terminal;
  const bool asked = wishes_.any(0) || wishes_.any(1) || places_.any(1);
  starts_ = graph_.bestStarts(events[1].time - events[0].time, heardOf(events[0]), second,
                              settings.mostStarts * (asked ? kMoreStarts : 1));
  if (!asked) return;
  std::erase_if(starts_, [this](const PathStart& start) {
    return !lies(0, start.first) || !lies(1, start.second());
  });
  if (places_.any(1)) {
    const Standing first = standing({});
    for (PathStart& start : starts_) start.total += placeOf(first, 1, start.first, start.first, 0);
    std::stable_sort(starts_.begin(), starts_.end(),
                     [](const PathStart& a, const PathStart& b) { return a.total > b.total; });
  }
  if (starts_.size() > settings.mostStarts) starts_.resize(settings.mostStarts);
}

GraphSearch::Standing GraphSearch::standing(const GraphPath& path) {
  Standing standing;
  if (!places_.any()) return standing;
  (void)places_.meet(0, Eigen::Vector2d::Zero(), standing.registered);
  for (int level = 0; level < path.last(); ++level) {
    const GraphEdge& edge = path.edges[static_cast<std::size_t>(level)];
    standing.placement = standing.placement.after(
        connector_.placement(path.event(level), edge.sibling, edge.symmetry));
    const PlanarTransform& plane = standing.placement.plane;
    (void)places_.meet(static_cast<std::size_t>(level) + 1, {plane.x, plane.y},
                       standing.registered);
  }
  return standing;
}

/// Log f_p where the edge leads from `event`, which lies as `from` tells, to `level`.
double GraphSearch::placeOf(const Standing& from, int level, std::uint32_t event,
                            std::uint32_t sibling, std::uint32_t symmetry) {
  const auto index = static_cast<std::size_t>(level);
  if (!places_.any(index)) return 0;
  const PlanarTransform plane =
      from.placement.after(connector_.placement(event, sibling, symmetry)).plane;
  Registered registered = from.registered;
  return places_.meet(index, {plane.x, plane.y}, registered);
}

/// As is asked for there, if anything is.
bool GraphSearch::lies(int level, std::uint32_t event) const {
  const auto index = static_cast<std::size_t>(level);
  return !wishes_.any(index) || wishes_.met(index, graph_.event(event));
}

/// The same of the event that follows `event` in its simulation. Edges that lead to events that lie
/// so start at ones like it.
bool GraphSearch::ownWayLies(int level, std::uint32_t event) const {
  const bool followed = (graph_.database().flags()[event] & EventRecord::kFollowed) != 0;
  return followed && lies(level, event + 1);
}

int GraphSearch::levels() const { return static_cast<int>(request_.signature.events.size()); }

bool GraphSearch::spent() const { return stopped_ || queries_ > mostQueries_; }

/// T* of the edge that leaves the path's last event. Starts are met exactly, so the signature's
/// times are the plan's.
double GraphSearch::timeAfter(const GraphPath& path) const {
  const auto level = static_cast<std::size_t>(path.last());
  const auto& events = request_.signature.events;
  return events[level + 1].time - events[level].time -
         connector_.event(path.event(path.last())).end;
}

/// The turn from the edge that arrives at `level` to `sibling`. How the body arrives depends on the
/// event that it comes from, too.
GraphSearch::Turn GraphSearch::turn(const GraphPath& path, int level, std::uint32_t sibling) {
  if (level == 0) return {path.first, 0, path.first, path.first, sibling};
  const GraphEdge& arriving = path.edges[static_cast<std::size_t>(level) - 1];
  return {path.first, level, path.event(level - 1), arriving.sibling, sibling};
}

bool GraphSearch::banned(const GraphPath& path, std::uint32_t sibling) const {
  const int level = path.last();
  if (noFlight_.count({level, path.event(level), sibling}) > 0) return true;
  return noTurn_.count(turn(path, level, sibling)) > 0;
}

/// The best edges that leave the path's last event, and as many more as are known to lead nowhere.
const std::vector<GraphChild>& GraphSearch::children(const GraphPath& path) {
  const int level = path.last();
  const std::uint32_t event = path.event(level);
  const bool placed = places_.any(static_cast<std::size_t>(level) + 1);
  const auto key = std::tuple(path.first, level, event);
  const auto bans = bans_.find({level, event});
  const std::size_t extra = bans == bans_.end() ? 0 : bans->second;
  const std::size_t wanted = std::min(settings_.children + extra, graph_.database().events());
  const auto known = placed ? children_.end() : children_.find(key);
  if (known != children_.end() && known->second.servesFor(wanted)) return known->second.found;
  ++queries_;
  stopped_ = stopped_ || stop_();
  if (placed) return placed_ = find(path, wanted);
  if (children_.size() > kMostLists) children_.clear();
  return children_.insert_or_assign(key, Children{wanted, find(path, wanted)}).first->second.found;
}

std::vector<GraphChild> GraphSearch::find(const GraphPath& path, std::size_t wanted) {
  const int level = path.last();
  const std::uint32_t event = path.event(level);
  const ContactEvent& left = connector_.event(event);
  TransitionTarget target;
  target.time = timeAfter(path);
  target.heard = heardOf(request_.signature.events[static_cast<std::size_t>(level) + 1]);
  target.terminal = level + 2 == levels() && request_.signature.terminal;
  target.firstAmplitude = path.firstAmplitude;
  const bool ahead = level + 2 < levels() && settings_.lookAhead > 1;
  const bool asked = wishes_.any(static_cast<std::size_t>(level) + 1);
  const bool askedNext = ahead && wishes_.any(static_cast<std::size_t>(level) + 2);
  const bool placed = places_.any(static_cast<std::size_t>(level) + 1);
  const Standing here = placed ? standing(path) : Standing();
  const TransitionSource source{left.before, left.after};
  std::vector<GraphChild> found;
  const auto add = [&](const Transition& edge) {
    if (asked && !lies(level + 1, edge.event())) return;
    GraphChild child{edge, 0, edge.total};
    child.place = placeOf(here, level + 1, event, edge.sibling, edge.symmetry);
    child.worth += child.place;
    if (ahead) lookAhead_.rate(level + 1, child);
    if (askedNext && !ownWayLies(level + 2, edge.event())) child.worth -= kLiesOtherwise;
    if (child.bound > graph_.settings().leastVelocity) found.push_back(child);
  };
  // Where most cannot go on from there, more are looked at.
  std::size_t factor = ahead ? settings_.lookAhead : 1;
  // Few events lead to rest, to one that lies as asked, or to a place: they must be looked for.
  const bool lastButOne = level + 3 == levels() && request_.signature.terminal;
  if (lastButOne || askedNext || placed) factor *= factor;
  for (; !left.touchingAfter; factor *= std::max<std::size_t>(2, settings_.lookAhead)) {
    const std::vector<Transition> edges = graph_.best(source, target, wanted * factor);
    found.clear();
    for (const Transition& edge : edges) add(edge);
    const bool all = edges.size() < wanted * factor;
    if ((!ahead && !asked) || all || found.size() >= wanted || factor >= kMostAhead) break;
  }
  const EdgeWeight silence = graph_.silentWeight(target, event);
  if (silence.exists()) add({event, silence, silence.total(), 0});
  std::sort(found.begin(), found.end(), [](const GraphChild& a, const GraphChild& b) {
    return a.worth != b.worth ? a.worth > b.worth : a.transition.sibling < b.transition.sibling;
  });
  if (found.size() > wanted) found.resize(wanted);
  return found;
}

/// Depth first, the best edges first. All weights are at most 0, and that of the next edge at most
/// its bound: a path that is no better than the best one need not be followed.
void GraphSearch::descend(GraphPath& path, int depth, double total) {
  if (depth == 0) {
    best_ = path;
    bestTotal_ = total;
    return;
  }
  if (spent()) return;
  const std::vector<GraphChild> list = children(path);
  std::size_t followed = 0;
  for (const GraphChild& child : list) {
    const Transition& next = child.transition;
    if (followed == settings_.children) return;
    if (banned(path, next.sibling)) continue;
    ++followed;
    const double reached = total + next.total + child.place;
    if (reached + (depth > 1 ? child.bound : 0) <= bestTotal_) continue;
    path.edges.push_back({next.sibling, timeAfter(path), next.weight, next.symmetry, child.place});
    descend(path, depth - 1, reached);
    path.edges.pop_back();
  }
}

void GraphSearch::descendFromStarts(int depth) {
  const Standing here = standing({});
  for (std::size_t i = 0; i < std::min(settings_.starts, starts_.size()); ++i) {
    const PathStart& start = starts_[i];
    if (start.total <= bestTotal_) return;
    if (usedStarts_.count(start.first) > 0) continue;
    GraphPath path;
    path.first = start.first;
    path.firstAmplitude = graph_.event(start.first).amplitude;
    path.sound = start.sound;
    if (banned(path, start.first)) continue;
    path.edges.push_back({start.first, timeAfter(path), start.weight, 0,
                          placeOf(here, 1, start.first, start.first, 0)});
    descend(path, depth - 1, start.total);
  }
}

int GraphSearch::depthFrom(const GraphPath& kept) const {
  return std::min(settings_.horizon, levels() - 1 - kept.last());
}

/// The best path that goes on from `kept` (from any start where that has no edges) for `depth`
/// contacts, whose connections are made.
std::optional<GraphPath> GraphSearch::bestFrom(const GraphPath& kept, int depth) {
  while (!spent()) {
    best_.reset();
    bestTotal_ = kNothing;
    if (kept.edges.empty()) {
      descendFromStarts(depth);
    } else {
      GraphPath path = kept;
      descend(path, depth, kept.total());
    }
    if (!best_ || allConnect(*best_)) return best_;
  }
  return {};
}

/// Makes the connection that leaves the event of `level`. Where there is none the edge is banned.
bool GraphSearch::connects(const GraphPath& path, int level) {
  const auto index = static_cast<std::size_t>(level);
  const GraphEdge& edge = path.edges[index];
  const std::uint32_t event = path.event(level);
  const ConnectedEdge& made = connector_.edge(level, event, edge.sibling, edge.symmetry, edge.time);
  bool good = made.feasible;
  if (!good) {
    noFlight_.insert({level, event, edge.sibling});
  } else {
    const GraphEdge* before = level == 0 ? nullptr : &path.edges[index - 1];
    const ConnectedEdge* arrival =
        before == nullptr ? nullptr
                          : &connector_.edge(level - 1, path.event(level - 1), before->sibling,
                                             before->symmetry, before->time);
    good = connector_.energyAllows(event, arrival, made);
    if (!good) noTurn_.insert(turn(path, level, edge.sibling));
  }
  if (!good) ++bans_[{level, event}];
  return good;
}

bool GraphSearch::allConnect(const GraphPath& path) {
  for (int level = 0; level < path.last(); ++level) {
    if (!connects(path, level)) return false;
    if (level + 1 > farthest_.last()) {
      farthest_ = path;
      farthest_.edges.resize(static_cast<std::size_t>(level) + 1);
    }
  }
  return true;
}

void GraphSearch::newStart() {
  deadEnds_ = 0;
  deadAt_.assign(static_cast<std::size_t>(levels()), 0);
}

/// Nothing leads on from `kept`: gives up as many of its last edges as times it ended there, since
/// what was lacking may have been lost long before. False when the start is given up.
bool GraphSearch::stepBack(GraphPath& kept) {
  const int most = std::max(1, kept.last() - 1);
  const int edges = std::min(++deadAt_[static_cast<std::size_t>(kept.last())], most);
  ++deadEnds_;
  for (int i = 0; i < edges; ++i) {
    const int level = kept.last() - 1;
    const std::uint32_t sibling = kept.edges.back().sibling;
    kept.edges.pop_back();
    if (kept.edges.empty() || deadEnds_ > settings_.mostDeadEnds) {
      usedStarts_.insert(kept.first);
      return false;
    }
    noTurn_.insert(turn(kept, level, sibling));
    ++bans_[{level, kept.event(level)}];
  }
  return true;
}

/// Without the look-ahead, which gives up the contact before the one to blame.
void GraphSearch::reachFarthest() {
  children_.clear();
  stop_ = [] { return false; };
  stopped_ = false;
  mostQueries_ = queries_ + queries_ / 10 + 100;
  const std::size_t ahead = std::exchange(settings_.lookAhead, 1);
  const GraphPath kept = farthest_;
  const int most = depthFrom(kept);
  for (int depth = 1; depth <= most && bestFrom(kept, depth); ++depth) {
  }
  settings_.lookAhead = ahead;
  children_.clear();
}

std::optional<GraphPath> GraphSearch::next() {
  GraphPath kept;
  newStart();
  while (!spent()) {
    if (progress) progress(static_cast<double>(kept.last()) / (levels() - 1));
    const std::optional<GraphPath> window = bestFrom(kept, depthFrom(kept));
    if (!window) {
      if (kept.edges.empty()) {
        if (settings_.starts >= starts_.size()) return {};
        settings_.starts *= 4;
        continue;
      }
      if (!stepBack(kept)) {
        kept = {};
        newStart();
      }
      continue;
    }
    if (window->last() == levels() - 1) {
      usedStarts_.insert(window->first);
      return window;
    }
    const int keep = std::min(kept.last() + settings_.commit, window->last());
    kept = *window;
    kept.edges.resize(static_cast<std::size_t>(keep));
  }
  return {};
}

}  // namespace ifa
