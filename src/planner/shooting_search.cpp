// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_search.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <set>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "planner/shooting_worker.h"
#include "sampler/drop_statistics.h"

namespace ifa {

namespace {

constexpr std::size_t kBatch = 64;  ///< motions expanded before the bound is looked at again
constexpr std::size_t kMostComplete = 64;
constexpr double kNoBound = -1e300;

bool better(const ShootingNode& a, const ShootingNode& b) { return a.worth() > b.worth(); }

/// Log units for gaps that a motion has where others are wanted: what lies farther ahead can still
/// be changed, and one that does not fit is no reason to forget how well the others do.
double rhythmCost(const std::vector<double>& gaps, const std::vector<double>& wanted) {
  constexpr double kPrecision = 0.003, kShare = 0.1, kMost = 9, kFade = 0.7;
  double cost = 0, weight = 1;
  for (std::size_t m = 0; m < wanted.size(); ++m, weight *= kFade) {
    double step = kMost;
    if (m < gaps.size()) {
      const double off = (gaps[m] - wanted[m]) / (kPrecision + kShare * wanted[m]);
      step = std::min(kMost, off * off);
    }
    cost += weight * step;
  }
  return cost;
}

/// Keeps the best few complete motions, best first. Where several takes are wanted, no more than a
/// take's share of one first contact, unless there is room: what differs late differs little.
/// Returns what another one must be worth to be kept.
double keepComplete(std::vector<ShootingNode>& done, int takes) {
  std::stable_sort(done.begin(), done.end(), better);
  const std::size_t ofOneRoot = kMostComplete / static_cast<std::size_t>(std::max(1, takes));
  std::map<unsigned, std::size_t> ofRoot;
  std::vector<ShootingNode> kept, more;
  for (ShootingNode& node : done) {
    (++ofRoot[node.root] <= ofOneRoot ? kept : more).push_back(std::move(node));
  }
  if (kept.size() > kMostComplete) kept.resize(kMostComplete);
  const double bound = kept.size() == kMostComplete ? kept.back().worth() : kNoBound;
  const std::size_t room = std::min(kMostComplete - kept.size(), more.size());
  std::move(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(room),
            std::back_inserter(kept));
  done = std::move(kept);
  std::stable_sort(done.begin(), done.end(), better);
  return bound;
}

std::size_t firstOf(const std::vector<bool>& hard) {
  const auto first = std::find(hard.begin(), hard.end(), true);
  return first == hard.end() ? 0 : static_cast<std::size_t>(first - hard.begin());
}

}  // namespace

ShootingProblem::ShootingProblem(const PlanRequest& planned, const ShootingPlannerSettings& tuning)
    : request(planned),
      settings(tuning),
      model(*planned.body, planned.surface),
      wishes(planned),
      places(planned) {
  recorder = audibleCut(*planned.body, planned.surface);
  std::vector<double> times, amplitudes;
  for (const SignatureEvent& event : planned.signature.events) {
    targets.push_back(heardOf(event));
    times.push_back(event.time);
    amplitudes.push_back(event.amplitude);
  }
  for (std::size_t k = 0; k + 1 < targets.size(); ++k) {
    features.push_back(EnergyOutlook::features(times, amplitudes, k));
  }
  if (planned.outlook) {
    outlook = *planned.outlook;
  } else if (targets.size() > 1) {
    outlook = EnergyOutlook::learn(*planned.body, model, recorder, settings.outlookDrops);
  }
  const bool aiming = settings.aimedEvents + settings.aimedEndings + settings.aimedRoots > 0;
  if (planned.database != nullptr && aiming) aim();
}

ShootingProblem::ShootingProblem(const ShootingProblem& other, const PlanRequest& planned)
    : request(planned),
      settings(other.settings),
      model(other.model),
      recorder(other.recorder),
      wishes(other.wishes),
      places(other.places),
      outlook(other.outlook),
      targets(other.targets),
      features(other.features),
      group(other.group),
      aims(other.aims),
      starts(other.starts) {}

void ShootingProblem::aim() {
  const EventDatabase& database = *request.database;
  if (request.settings.symmetry) group = request.symmetry;
  if (group.empty()) group = {Eigen::Matrix3d::Identity()};
  std::vector<std::vector<RhythmMatch>> matches(targets.size());
  parallelFor(targets.size(), [&](std::size_t level) {
    const bool ends = level + 1 == targets.size() && request.signature.terminal;
    const int count = ends         ? settings.aimedEndings
                      : level == 0 ? settings.aimedRoots
                                   : settings.aimedEvents;
    matches[level] =
        eventsInRhythm(database, request.signature, level, static_cast<std::size_t>(count));
  });
  for (const RhythmMatch& match : matches[0]) starts.push_back(match.event);
  // No motion comes to the first contact from another one.
  matches[0].clear();
  for (const auto& events : matches) {
    aims.emplace_back(database, events, group, request.body->radius);
  }
}

void ShootingDeaths::operator+=(const ShootingDeaths& o) {
  noTime += o.noTime;
  noFlight += o.noFlight;
  bent += o.bent;
  energy += o.energy;
  earlier += o.earlier;
  unheard += o.unheard;
  restless += o.restless;
}

void ShootingWork::operator+=(const ShootingWork& other) {
  pieces += other.pieces;
  flights += other.flights;
}

double ShootingWork::cost() const {
  constexpr double kFlight = 10;
  return static_cast<double>(pieces) + kFlight * static_cast<double>(flights);
}

ShootingSearch::ShootingSearch(const ShootingProblem& problem, std::uint64_t pass, double width,
                               std::vector<bool> hard)
    : problem_(problem),
      pass_(pass),
      width_(width),
      hard_(std::move(hard)),
      firstHard_(firstOf(hard_)),
      levels_(problem.targets.size()),
      deaths_(problem.targets.size()),
      costBefore_(problem.targets.size()) {}

ShootingSearch::ShootingSearch(const ShootingProblem& problem, const ShootingSearch& other,
                               std::uint64_t pass, double width, Beginning beginning)
    : ShootingSearch(problem, pass, width, other.hard_) {
  begin_ = beginning.level;
  inTurns_ = beginning.inTurns;
  std::copy_n(other.levels_.begin(), begin_, levels_.begin());
  levels_[begin_] = std::move(beginning.beam);
}

void ShootingSearch::run(const std::function<bool()>& stop,
                         const std::function<void(double)>& progress) {
  if (begin_ == 0) plantRoots(stop);
  const std::size_t n = levels_.size();
  for (std::size_t level = begin_; level < n && !stop(); ++level) {
    costBefore_[level] = work_.cost();
    if (level + 1 == n) {
      complete_ = levels_[level];
      keepComplete(complete_, problem_.request.settings.takes);
      break;
    }
    if (level < hard_.size() && hard_[level]) {
      keepBest(levels_[level], widthAt(level), problem_.settings.hardBeam);
      followOn(levels_[level], level);
    }
    keepBest(levels_[level], widthAt(level), 1);
    expandLevel(level, stop);
    progress(static_cast<double>(level + 1) / static_cast<double>(n));
  }
}

/// What a pass is to find lies at the hard contacts: up to there it is no wider than the first.
double ShootingSearch::widthAt(std::size_t level) const {
  return level < firstHard_ ? std::min(width_, 1.0) : width_;
}

void ShootingSearch::plantRoots(const std::function<bool()>& stop) {
  const auto& set = problem_.settings;
  const double width = widthAt(0);
  const auto fresh = static_cast<std::size_t>(set.firstContacts * width);
  const bool few = static_cast<int>(levels_.size()) <= set.fewContacts;
  const auto late = few ? static_cast<std::size_t>(set.lateContacts * width) : 0;
  const std::uint64_t seed = problem_.request.settings.seed + (pass_ << 32);
  const std::size_t sampled = fresh + late, count = sampled + problem_.starts.size(),
                    batches = (count + kBatch - 1) / kBatch;
  std::vector<std::vector<ShootingNode>> made(batches);
  std::vector<ShootingWork> work(batches);
  parallelFor(batches, [&](std::size_t batch) {
    if (stop()) return;
    ShootingWorker worker(problem_);
    for (std::size_t i = batch * kBatch; i < std::min(count, (batch + 1) * kBatch); ++i) {
      const auto root = static_cast<unsigned>(i);
      if (i >= sampled) {
        worker.plantEvent(root, problem_.starts[i - sampled]);
      } else {
        i < fresh ? worker.plant(root, seed) : worker.plantLate(root, seed);
      }
    }
    made[batch] = std::move(worker.children);
    work[batch] = worker.work();
  });
  for (const ShootingWork& done : work) work_ += done;
  for (auto& nodes : made) levels_[0].insert(levels_[0].end(), nodes.begin(), nodes.end());
}

void ShootingSearch::expandLevel(std::size_t level, const std::function<bool()>& stop) {
  const auto& events = problem_.request.signature.events;
  const std::size_t n = events.size();
  // Where few motions are left, each gets more children: the work, not the hope, stays the same.
  const auto& set = problem_.settings;
  const double few = set.beam * widthAt(level) /
                     static_cast<double>(std::max<std::size_t>(1, levels_[level].size()));
  const double effort = std::clamp(few, 1.0, set.mostEffort);
  for (std::size_t next = level + 1; next < n; ++next) {
    const bool last = next + 1 == n;
    double bound = kNoBound;
    for (std::size_t begin = 0; begin < levels_[level].size() && !stop(); begin += kBatch) {
      const std::size_t end = std::min(levels_[level].size(), begin + kBatch);
      std::vector<ShootingWorker> workers(end - begin, ShootingWorker(problem_));
      parallelFor(end - begin, [&](std::size_t i) {
        if (stop()) return;
        const std::size_t index = begin + i;
        const RandomStream random(problem_.request.settings.seed ^ (pass_ << 48),
                                  (static_cast<std::uint64_t>(level) << 40) + (next << 24) + index);
        workers[i].expand(levels_[level][index], static_cast<int>(index), static_cast<int>(next),
                          effort, random, bound);
      });
      for (ShootingWorker& worker : workers) {
        deaths_[level] += worker.deaths;
        work_ += worker.work();
        auto& to = levels_[next];
        to.insert(to.end(), worker.children.begin(), worker.children.end());
      }
      // Of complete motions only the best few matter; at other contacts rank decides later.
      if (last && levels_[next].size() > kMostComplete) {
        auto& done = levels_[next];
        bound = keepComplete(done, problem_.request.settings.takes);
      }
    }
    if (events[next].weight >= 1) break;
  }
}

/// Ranks motions also by how their own rhythm, when they are left to themselves, fits the contacts
/// that follow: where several gaps in a row cannot be flown, it must fit as it is.
void ShootingSearch::followOn(std::vector<ShootingNode>& nodes, std::size_t level) {
  const auto& events = problem_.request.signature.events;
  const auto& set = problem_.settings;
  const std::size_t count =
      std::min(static_cast<std::size_t>(set.hardAhead), events.size() - 1 - level);
  std::vector<double> wanted;
  for (std::size_t m = 0; m < count; ++m)
    wanted.push_back(events[level + m + 1].time - events[level + m].time);
  const double horizon = 1.3 * (events[level + count].time - events[level].time) + 0.02;
  std::atomic<long> pieces = 0;
  parallelFor(nodes.size(), [&](std::size_t i) {
    EventSimulation simulation(problem_.model, problem_.recorder);
    ShootingNode& node = nodes[i];
    std::vector<double> gaps = simulation.rhythm(node.event.after, count, horizon);
    if (!gaps.empty()) gaps[0] += node.event.end;
    node.rank -= set.hardWeight * rhythmCost(gaps, wanted);
    pieces += simulation.pieces();
  });
  work_.pieces += pieces;
}

void ShootingSearch::keepBest(std::vector<ShootingNode>& candidates, double width,
                              double wider) const {
  const auto& set = problem_.settings;
  const double beam = wider * set.beam * width;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.rank > b.rank; });
  std::map<std::pair<int, int>, int> ofParent;
  std::map<unsigned, int> ofRoot;
  std::map<int, int> ofBin;
  std::vector<ShootingNode> kept;
  const auto most = static_cast<std::size_t>(beam);
  // Where few parents, or few first contacts, are left, the beam is still filled from them.
  std::set<std::pair<int, int>> parents;
  std::set<unsigned> roots;
  for (const ShootingNode& node : candidates) {
    parents.insert({node.parentLevel, node.parent});
    roots.insert(node.root);
  }
  const auto share = [&](int quota, std::size_t groups) {
    const double even = 1.5 * beam / static_cast<double>(std::max<std::size_t>(1, groups));
    return std::max(static_cast<int>(quota * wider), static_cast<int>(even));
  };
  const int perParent = share(set.perParent, parents.size());
  // A search that goes on from several kinds of motion is to end with all of them.
  const double ofEach = beam / static_cast<double>(std::max<std::size_t>(1, roots.size()));
  const int perRoot =
      begin_ > 0 ? std::max(1, static_cast<int>(ofEach)) : share(set.perRoot, roots.size());
  for (const ShootingNode& node : candidates) {
    if (kept.size() >= most) break;
    const double above = std::max(node.energyAfter - problem_.outlook.restEnergy(), 1e-12);
    const int bin = static_cast<int>(portableLog(above) / set.energyBin + 1000);
    int& parent = ofParent[{node.parentLevel, node.parent}];
    int &root = ofRoot[node.root], &energy = ofBin[bin];
    const bool full = (node.parent >= 0 && parent >= perParent) || root >= perRoot ||
                      energy >= static_cast<int>(set.perEnergyBin * beam / set.beam);
    if (full) continue;
    ++parent;
    ++root;
    ++energy;
    kept.push_back(node);
  }
  candidates = inTurns_ ? inTurns(kept) : std::move(kept);
}

/// What costs most is tried on the first motions of a beam only: so the best of each kind come
/// first, then the second best of each.
std::vector<ShootingNode> ShootingSearch::inTurns(const std::vector<ShootingNode>& nodes) {
  std::map<unsigned, int> seen;
  std::multimap<int, ShootingNode> ordered;
  for (const ShootingNode& node : nodes) ordered.emplace(seen[node.root]++, node);
  std::vector<ShootingNode> sorted;
  for (auto& [turn, node] : ordered) sorted.push_back(std::move(node));
  return sorted;
}

const ShootingNode* ShootingSearch::farthest() const {
  for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
    if (!level->empty()) return &*std::min_element(level->begin(), level->end(), better);
  }
  return nullptr;
}

std::vector<Eigen::Vector2d> ShootingSearch::pathTo(const ShootingNode& node) const {
  std::vector<Eigen::Vector2d> points = {node.event.after.position.head<2>()};
  const ShootingNode* at = &node;
  for (;; at = &levels_[static_cast<std::size_t>(at->parentLevel)]
                       [static_cast<std::size_t>(at->parent)]) {
    points.emplace_back(at->event.before.position.head<2>());
    if (at->parent < 0) break;
  }
  std::reverse(points.begin(), points.end());
  return points;
}

std::vector<ShootingNode> ShootingSearch::path(const ShootingNode& node) const {
  std::vector<ShootingNode> nodes = {node};
  while (nodes.back().parent >= 0) {
    const ShootingNode& last = nodes.back();
    nodes.push_back(
        levels_[static_cast<std::size_t>(last.parentLevel)][static_cast<std::size_t>(last.parent)]);
  }
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace ifa
