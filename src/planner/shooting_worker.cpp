// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_worker.h"

#include <algorithm>
#include <cmath>

#include "dynamics/energy.h"
#include "dynamics/simulator.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace ifa {

namespace {

constexpr double kLongestDrop = 10;  // s
/// Decision: in a region that is marked as one sound, contacts so far apart are one event. It is
/// what the paper closes for bodies that rattle; people mark even fainter chatter as one, s.
constexpr double kRegionGap = 0.03;
/// A restitution under this may be off by as much as this one: a share of little is nothing.
constexpr double kLively = 0.5;
/// Ways to end one event that are followed up.
constexpr std::size_t kMostEndings = 3;

}  // namespace

PlausibleRegion ShootingWorker::regionOf(const ContactEvent& event) const {
  return PlausibleRegion(event.after.velocity - event.before.velocity,
                         event.after.angularVelocity - event.before.angularVelocity,
                         problem_.model.radius);
}

void ShootingWorker::plant(unsigned root, std::uint64_t seed) {
  const RigidState start = sampleInitialState(*problem_.request.body, seed, root);
  ShootingNode node;
  node.root = root;
  arrive(node, node, {}, start, problem_.model.surface.restitution, -1e300);
}

/// Silence is simulated for so long; later contacts are all just too late.
double ShootingWorker::silentHorizon(double duration) { return 1.3 * duration + 0.01; }

/// By how much a passage may miss the time that it is shown in, s.
double ShootingWorker::slack(double duration) const {
  return std::max(kSilentPrecision, duration * settings().timeWarp / (1 + settings().timeWarp));
}

SilentSearchSettings ShootingWorker::silentSettings(int probes, double duration) const {
  return {probes, problem_.settings.silentTries, problem_.settings.spread, slack(duration)};
}

/// From the end of a whole drop: the event after which as many follow as the signature has. A sound
/// of few contacts is rarely a hard throw, and one of a single contact never is.
void ShootingWorker::plantLate(unsigned root, std::uint64_t seed) {
  const RigidState start = sampleInitialState(*problem_.request.body, seed, root);
  const DropResult drop = simulateDrop(problem_.model, start, kLongestDrop);
  const std::vector<ContactEvent> events = eventsOf(drop, problem_.recorder);
  if (events.size() < problem_.targets.size()) return;
  ShootingNode node;
  node.root = root;
  arrive(node, node, {}, events[events.size() - problem_.targets.size()].before,
         problem_.model.surface.restitution, -1e300);
}

/// Contacts that are to be heard apart stay a merge gap apart, but for rounding.
double ShootingWorker::shortestPassage() const { return problem_.recorder.mergeGap - 1e-6; }

/// Whether the body is to come to rest at that target.
bool ShootingWorker::closes(int level) const {
  return level + 1 == static_cast<int>(problem_.targets.size()) &&
         problem_.request.signature.terminal;
}

/// What sounds within a region that was marked is one event, if it does not fall silent for long.
double ShootingWorker::mergeGapOf(std::size_t level) const {
  const double gap = problem_.recorder.mergeGap;
  return problem_.targets[level].duration > 0 ? std::max(gap, kRegionGap) : gap;
}

double ShootingWorker::droppedBetween(int from, int to) const {
  double penalty = 0;
  for (int k = from + 1; k < to; ++k) {
    penalty += kDropPrice * problem_.request.signature.events[static_cast<std::size_t>(k)].weight;
  }
  return penalty;
}

/// No two places of a body and a floor are alike: every other attempt has a restitution of its own.
/// At the contact in which it is to come to rest, every third may be deader by any amount, like a
/// face that comes down flat on the air under it: few motions come to rest there otherwise.
double ShootingWorker::variedRestitution(int level, int attempt, RandomStream& random) const {
  const double nominal = problem_.model.surface.restitution;
  if (closes(level) && attempt % 3 == 2) return nominal * random.uniform();
  if (attempt % 2 == 0) return nominal;
  const double range = problem_.settings.restitutionRange * std::max(nominal, kLively);
  return std::clamp(nominal + range * random.uniform(-1, 1), 0.0, kMostRestitution);
}

void ShootingWorker::expand(const ShootingNode& node, int index, int level, double effort,
                            RandomStream random, double bound) {
  ShootingNode child;
  child.parent = index;
  child.parentLevel = node.level;
  child.level = level;
  child.root = node.root;
  child.firstAmplitude = node.firstAmplitude;
  child.log = node.log;
  child.ugly = node.ugly;
  child.registered = node.registered;
  child.log.sound -= droppedBetween(node.level, level);
  const SignatureEvent& target = problem_.request.signature.events[static_cast<std::size_t>(level)];
  child.start = target.time;
  // What it takes to the very next mark is known from its rank.
  const Way known{node.flightCost, node.silentOff, 0};
  const bool next = level == node.level + 1;
  expandTo(node, child, next ? known : wayTo(node, level, child.start), effort, random, bound);
  for (const AlternativeStart& other : target.alternatives) {
    child.start = other.time;
    child.moved = other.time - target.time;
    ShootingNode elsewhere = child;
    elsewhere.log.sound -= other.cost;
    expandTo(node, elsewhere, wayTo(node, level, other.time), effort, random, bound);
  }
}

/// The same where it is clear when the contact is to begin.
void ShootingWorker::expandTo(const ShootingNode& node, ShootingNode child, const Way& way,
                              double effort, RandomStream& random, double bound) {
  const auto& set = problem_.settings;
  const int n = static_cast<int>(problem_.targets.size()), level = child.level,
            index = child.parent;
  const double duration = child.start - node.start - node.event.end;
  if (duration < shortestPassage()) {
    ++deaths.noTime;
    return;
  }
  const PlausibleRegion region = regionOf(node.event);
  // The least change that flies there is known; where even that bends too much, none will do.
  const bool flies = way.flightCost < -logVelocity(1.2 * settings().bendCap);
  const int more = level >= n - set.lastContacts ? set.lastFactor : 1;
  if (!flies) ++deaths.bent;
  const bool steered = steeredTo(node, level, region, duration, 1).has_value();
  const int count = flies ? static_cast<int>(set.children * more * effort) : 0;
  for (int i = 0; i < count; ++i) {
    Coordinates wish = Coordinates::Zero();
    if (i > 0) {
      // From small changes to large ones: the small ones look best, the large ones reach farther.
      const double spread = set.spread * (0.25 + 0.75 * i / count);
      for (int axis = 0; axis < 6; ++axis) wish[axis] = spread * bellShaped(random);
    }
    const double restitution = variedRestitution(level, i, random);
    const double eager = i == 0 || !steered ? 1 : random.uniform(0.5, 1.5);
    TimeWarp time{duration, duration};
    if (i > 0 && settings().timeWarp > 0) {
      time.flightTime += slack(duration) * random.uniform(-1, 1);
    }
    shoot(node, child, region, wish, time, eager, restitution, bound);
  }
  const int aimed = level + 1 == n ? set.aimedEndingBeam : set.aimedBeam;
  if (flies && index < aimed && !problem_.aims.empty() && !node.event.touchingAfter) {
    shootAimed(node, child, region, duration, bound);
  }
  // A long silence takes long to simulate, and is as rare.
  const double silentBeam = set.silentBeam * std::min(1.0, 0.3 / duration);
  if (flies && level + 1 < n && index < silentBeam && stuckAfter(level)) {
    shootAhead(node, child, region, duration, random, bound);
  }
  // Where nothing flies there, silence is the only way, however far off it is now: a body that tips
  // over an edge takes any time, for a very small change.
  if (way.silentOff > (flies ? set.silentReach : kNever) || index >= silentBeam) return;
  const int probes = static_cast<int>((flies ? 0.5 : 1) * set.silentProbes);
  shootSilently(node, child, region, duration, probes, random, bound);
}

/// Whether none of the children so far has an easy way from `level` to the next contact.
bool ShootingWorker::stuckAfter(int level) const {
  return std::none_of(children.begin(), children.end(), [&](const ShootingNode& child) {
    return child.level == level &&
           std::min(child.flightCost, 0.5 + child.silentOff * child.silentOff) < 3;
  });
}

void ShootingWorker::shoot(const ShootingNode& node, ShootingNode child,
                           const PlausibleRegion& region, const Coordinates& wish,
                           const TimeWarp& time, double eager, double restitution, double bound) {
  const double duration = time.flightTime;
  const double mostEnergy = node.energyBefore * (1 + settings().energyGain);
  ++flights_;
  const auto flight = timeFlight(problem_.model, node.event.after, region, wish, duration,
                                 mostEnergy, steeredTo(node, child.level, region, duration, eager));
  if (!flight) {
    ++deaths.noFlight;
    return;
  }
  if (flight->bend > settings().bendCap || child.worth() + logVelocity(flight->bend) <= bound) {
    ++deaths.bent;
    return;
  }
  if (flight->energy > mostEnergy) {
    ++deaths.energy;
    return;
  }
  const auto touch = firstTouch(problem_.model, flight->departure, duration + 1e-3);
  if (!touch || std::abs(touch->time - duration) > kTouchPrecision) {
    ++deaths.earlier;
    return;
  }
  const Edge edge{flight->velocityChange, flight->angularVelocityChange, flight->bend,
                  Arrival::kFlight, time};
  arrive(node, child, edge, touch->state, restitution, bound);
}

/// The same where the next contact comes after silent contact, for which there is no closed form.
void ShootingWorker::shootSilently(const ShootingNode& node, const ShootingNode& child,
                                   const PlausibleRegion& region, double duration, int probes,
                                   RandomStream& random, double bound) {
  const double horizon = silentHorizon(duration);
  Edge edge;
  std::optional<NextContact> next;
  const auto probe = [&](const Coordinates& y) {
    region.change(y, edge.velocityChange, edge.angularChange);
    RigidState start = node.event.after;
    start.velocity += edge.velocityChange;
    start.angularVelocity += edge.angularChange;
    next.reset();
    if (!energyAllows(node.energyBefore, totalEnergy(problem_.model, start),
                      settings().energyGain)) {
      return SilentProbe{y, kNever, Eigen::Vector3d::Zero()};
    }
    next = simulation_.nextAudible(start, horizon);
    return silentProbe(y, next, horizon, duration);
  };
  int attempt = 0;
  const auto found = [&] {
    edge.bend = region.bend(edge.velocityChange, edge.angularChange);
    if (!next || edge.bend > settings().bendCap ||
        child.worth() + logVelocity(edge.bend) <= bound) {
      ++deaths.bent;
      return;
    }
    edge.arrival = next->silentContact ? Arrival::kSilentContact : Arrival::kFlight;
    const bool onTime = std::abs(next->delay - duration) < kSilentPrecision;
    edge.time = {next->delay, onTime ? next->delay : duration};
    const RigidState arrival = next->state;
    arrive(node, child, edge, arrival, variedRestitution(child.level, attempt++, random), bound);
  };
  findOnTime(probe, found, silentSettings(probes, duration), random);
}

/// Flies to the next contact such that what follows it in silence ends on time at the one after:
/// where a long gap comes with little energy, only motions that all but balance on an edge have the
/// time.
void ShootingWorker::shootAhead(const ShootingNode& node, const ShootingNode& child,
                                const PlausibleRegion& region, double duration,
                                RandomStream& random, double bound) {
  const double mostEnergy = node.energyBefore * (1 + settings().energyGain);
  const double after =
      problem_.request.signature.events[static_cast<std::size_t>(child.level + 1)].time;
  std::optional<TimedFlight> flight;
  std::optional<Touch> touch;
  const auto probe = [&](const Coordinates& y) {
    const SilentProbe never{y, kNever, Eigen::Vector3d::Zero()};
    ++flights_;
    flight = timeFlight(problem_.model, node.event.after, region, y, duration, mostEnergy);
    if (!flight || flight->bend > settings().bendCap || flight->energy > mostEnergy) return never;
    touch = firstTouch(problem_.model, flight->departure, duration + 1e-3);
    if (!touch || std::abs(touch->time - duration) > kTouchPrecision) return never;
    simulation_.outcomes(touch->state, problem_.model.surface.restitution, false, false, outcomes_,
                         mergeGapOf(static_cast<std::size_t>(child.level)));
    if (outcomes_.empty()) return never;
    const double gap = after - child.start - outcomes_[0].end;
    if (gap < shortestPassage()) return never;
    const double horizon = silentHorizon(gap);
    return silentProbe(y, simulation_.nextAudible(outcomes_[0].after, horizon), horizon, gap);
  };
  const auto found = [&] {
    const Edge edge{flight->velocityChange,
                    flight->angularVelocityChange,
                    flight->bend,
                    Arrival::kFlight,
                    {duration, duration}};
    arrive(node, child, edge, touch->state, problem_.model.surface.restitution, bound);
  };
  findOnTime(probe, found, silentSettings(problem_.settings.silentProbes, after - child.start),
             random);
}

/// Simulates the contact event and keeps the ways it may end that fit the target best.
void ShootingWorker::arrive(const ShootingNode& node, ShootingNode child, const Edge& edge,
                            const RigidState& arrival, double restitution, double bound,
                            const Jump& jump) {
  const auto k = static_cast<std::size_t>(child.level);
  const HeardEvent& target = problem_.targets[k];
  const bool last = k + 1 == problem_.targets.size();
  const bool terminal = closes(child.level);
  RigidState start = arrival;
  start.velocity += jump.linear;
  start.angularVelocity += jump.angular;
  const bool jumps = start.velocity != arrival.velocity;
  simulation_.outcomes(start, restitution, terminal, !last, outcomes_, mergeGapOf(k));
  if (outcomes_.empty()) ++(terminal ? deaths.restless : deaths.unheard);
  const bool first = child.parent < 0;
  child.velocityChange = edge.velocityChange;
  child.angularChange = edge.angularChange;
  child.arrival = edge.arrival;
  child.restitution = restitution;
  child.source = jump.source;
  if (!first) {
    child.start = node.start + node.event.end + edge.time.shownTime;
    child.retiming = edge.time.stretch();
    const double warp = logTimeWarp(child.retiming, 1);
    child.log.motion += warp;
    child.ugly += (1 - problem_.settings.warpWeight) * warp;
  }
  const double nominal = problem_.model.surface.restitution;
  // A change of restitution changes the rebound as a change of velocity along the impulse would.
  const double rebound =
      std::abs(restitution - nominal) / (1 + nominal) / AffinityParameters().maxRelativeLinear;
  child.bend = std::sqrt(edge.bend * edge.bend + rebound * rebound);
  const auto& set = problem_.settings;
  const double large = std::max(0.0, child.bend - set.largeBend);
  child.ugly += set.bendAversion * large * large;
  child.log.motion += logVelocity(child.bend);
  child.log.velocity += logVelocity(child.bend);
  if (child.bend > settings().bendCap) return;

  std::vector<ShootingNode> endings;
  for (const ContactEvent& event : outcomes_) {
    ShootingNode ending = child;
    ending.event = event;
    if (first) ending.firstAmplitude = event.amplitude;
    ending.heard = heardOf(event, ending.firstAmplitude);
    ending.log.sound += logAmplitude(target, ending.heard) + logDuration(target, ending.heard) +
                        logCentroid(target, ending.heard);
    if (jumps && !makesUpFor(jump, arrival, ending)) continue;
    ending.ugly -= problem_.wishes.log(k, event);
    ending.ugly -= problem_.places.meet(k, event.before.position.head<2>(), ending.registered);
    if (ending.worth() > bound) endings.push_back(ending);
  }
  std::stable_sort(endings.begin(), endings.end(),
                   [](const auto& a, const auto& b) { return a.worth() > b.worth(); });
  if (endings.size() > kMostEndings) endings.resize(kMostEndings);
  for (ShootingNode& ending : endings) {
    ending.energyBefore = totalEnergy(problem_.model, arrival);
    ending.energyAfter = totalEnergy(problem_.model, ending.event.after);
    judge(ending);
    children.push_back(ending);
  }
}

HeardEvent ShootingWorker::heardOf(const ContactEvent& event, double firstAmplitude) const {
  const double length = event.filteredDuration(problem_.recorder.mergeGap);
  return {event.amplitude / firstAmplitude, length, length > 0 ? event.centroid : 0};
}

}  // namespace ifa
