// SPDX-License-Identifier: Apache-2.0
#include "planner/shooting_worker.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "dynamics/energy.h"
#include "sampler/initial_state.h"

namespace ifa {

namespace {

/// A silent passage is timed to this, s; contact starts are exact to it.
constexpr double kSilentPrecision = 1e-6;
/// A touch that comes within this of the time asked for is that touch, s.
constexpr double kTouchPrecision = 1e-7;
/// Stands for a time that never comes, s.
constexpr double kNever = 1e8;
/// Ways to end one event that are followed up.
constexpr std::size_t kMostEndings = 3;

/// Nearly normal, without transcendental functions: four uniform numbers added up.
double bellShaped(RandomStream& random) {
  const double sum = random.uniform() + random.uniform() + random.uniform() + random.uniform();
  return (sum - 2) * 1.7320508075688772;
}

/// Illinois' false position with a bisection now and then: the function may jump where another
/// vertex comes first. Ends with a call of `miss` within the precision, or false.
template <class Miss>
bool closeIn(const Miss& miss, double low, double high, double atLow, double atHigh) {
  for (int step = 0; step < 30; ++step) {
    const double share = step % 3 == 2 ? 0.5 : atLow / (atLow - atHigh);
    const double middle = low + (high - low) * std::clamp(share, 0.01, 0.99);
    const double off = miss(middle);
    if (off > kNever) return false;
    if (std::abs(off) < kSilentPrecision) return true;
    if ((off < 0) == (atLow < 0)) {
      low = middle;
      atLow = off;
      atHigh *= 0.5;
    } else {
      high = middle;
      atHigh = off;
      atLow *= 0.5;
    }
  }
  return false;
}

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

/// Contacts that are to be heard apart stay a merge gap apart, but for rounding.
double ShootingWorker::shortestPassage() const { return problem_.recorder.mergeGap - 1e-6; }

double ShootingWorker::droppedBetween(int from, int to) const {
  double penalty = 0;
  for (int k = from + 1; k < to; ++k) {
    penalty += problem_.settings.dropPenalty *
               problem_.request.signature.events[static_cast<std::size_t>(k)].weight;
  }
  return penalty;
}

double ShootingWorker::variedRestitution(int level, int attempt, RandomStream& random) const {
  const double nominal = problem_.model.surface.restitution;
  const auto& target = problem_.targets[static_cast<std::size_t>(level)];
  const bool last = level + 1 == static_cast<int>(problem_.targets.size());
  if ((target.duration <= 0 && !last) || attempt % 2 == 0) return nominal;
  const double range = problem_.settings.restitutionRange;
  return std::min(0.95, nominal * (1 + range * random.uniform(-1, 1)));
}

void ShootingWorker::expand(const ShootingNode& node, int index, int level, double effort,
                            RandomStream random, double bound) {
  const auto& set = problem_.settings;
  const int n = static_cast<int>(problem_.targets.size());
  ShootingNode child;
  child.parent = index;
  child.parentLevel = node.level;
  child.level = level;
  child.root = node.root;
  child.firstAmplitude = node.firstAmplitude;
  child.log = node.log;
  child.log.sound -= droppedBetween(node.level, level);
  child.start = problem_.request.signature.events[static_cast<std::size_t>(level)].time;
  const double duration = child.start - node.start - node.event.end;
  if (duration < shortestPassage()) {
    ++deaths.noTime;
    return;
  }
  const PlausibleRegion region = regionOf(node.event);
  // The least change that flies there is known; where even that bends too much, none will do.
  const bool flies = node.flightCost < -logVelocity(1.2 * problem_.request.settings.bendCap);
  const int more = level >= n - set.lastContacts ? set.lastFactor : 1;
  const int count = flies ? static_cast<int>(set.children * more * effort) : 0;
  for (int i = 0; i < count; ++i) {
    Coordinates wish = Coordinates::Zero();
    if (i > 0) {
      // From small changes to large ones: the small ones look best, the large ones reach farther.
      const double spread = set.spread * (0.25 + 0.75 * i / count);
      for (int axis = 0; axis < 6; ++axis) wish[axis] = spread * bellShaped(random);
    }
    const double restitution = variedRestitution(level, i, random);
    shoot(node, child, region, wish, duration, restitution, bound);
  }
  if (node.silentOff > set.silentReach) return;
  const int tries =
      static_cast<int>(set.silentTries * (flies ? 1 : 3) * (more > 1 ? 2 : 1) * effort);
  for (int i = 0; i < tries; ++i) {
    Coordinates direction;
    for (int axis = 0; axis < 6; ++axis) direction[axis] = bellShaped(random);
    const double restitution = variedRestitution(level, i, random);
    shootSilently(node, child, region, direction.normalized(), duration, restitution, bound);
  }
}

void ShootingWorker::shoot(const ShootingNode& node, ShootingNode child,
                           const PlausibleRegion& region, const Coordinates& wish, double duration,
                           double restitution, double bound) {
  const double mostEnergy = node.energyBefore * (1 + problem_.request.settings.energyGain);
  const auto flight =
      timeFlight(problem_.model, node.event.after, region, wish, duration, mostEnergy);
  if (!flight) {
    ++deaths.noFlight;
    return;
  }
  if (flight->bend > problem_.request.settings.bendCap ||
      child.log.total() + logVelocity(flight->bend) <= bound) {
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
                  Arrival::kFlight, duration};
  arrive(node, child, edge, touch->state, restitution, bound);
}

/// The same where the next contact comes after silent contact, for which there is no closed form:
/// looks along a line of changes for one after which the next audible contact comes in time, then
/// bisects.
void ShootingWorker::shootSilently(const ShootingNode& node, ShootingNode child,
                                   const PlausibleRegion& region, const Coordinates& direction,
                                   double duration, double restitution, double bound) {
  Edge edge;
  edge.arrival = Arrival::kSilentContact;
  edge.duration = duration;
  std::optional<NextContact> next;
  const auto miss = [&](double s) {
    region.change(direction * s, edge.velocityChange, edge.angularChange);
    RigidState start = node.event.after;
    start.velocity += edge.velocityChange;
    start.angularVelocity += edge.angularChange;
    next.reset();
    if (energyAllows(node.energyBefore, totalEnergy(problem_.model, start),
                     problem_.request.settings.energyGain)) {
      next = simulation_.nextAudible(start, 2 * duration + 0.02);
    }
    return next ? next->delay - duration : 2 * kNever;
  };
  constexpr std::array<double, 5> kPlaces = {-0.9, -0.4, 0.0, 0.4, 0.9};
  std::array<double, 5> found{};
  for (std::size_t i = 0; i < kPlaces.size(); ++i) found[i] = miss(kPlaces[i]);
  for (std::size_t i = 0; i + 1 < kPlaces.size(); ++i) {
    if (found[i] > kNever || found[i + 1] > kNever || (found[i] < 0) == (found[i + 1] < 0))
      continue;
    if (!closeIn(miss, kPlaces[i], kPlaces[i + 1], found[i], found[i + 1])) continue;
    edge.bend = region.bend(edge.velocityChange, edge.angularChange);
    if (child.log.total() + logVelocity(edge.bend) <= bound) continue;
    if (!next->silentContact) edge.arrival = Arrival::kFlight;
    const RigidState arrival = next->state;
    edge.duration = next->delay;
    arrive(node, child, edge, arrival, restitution, bound);
  }
}

/// Simulates the contact event and keeps the ways it may end that fit the target best.
void ShootingWorker::arrive(const ShootingNode& node, ShootingNode child, const Edge& edge,
                            const RigidState& arrival, double restitution, double bound) {
  const auto k = static_cast<std::size_t>(child.level);
  const HeardEvent& target = problem_.targets[k];
  const bool last = k + 1 == problem_.targets.size();
  const bool terminal = last && problem_.request.signature.terminal;
  simulation_.outcomes(arrival, restitution, terminal, !last, outcomes_);
  if (outcomes_.empty()) ++(terminal ? deaths.restless : deaths.unheard);
  const bool first = child.parent < 0;
  child.velocityChange = edge.velocityChange;
  child.angularChange = edge.angularChange;
  child.arrival = edge.arrival;
  child.restitution = restitution;
  if (!first) child.start = node.start + node.event.end + edge.duration;
  const double nominal = problem_.model.surface.restitution;
  // A change of restitution changes the rebound as a change of velocity along the impulse would.
  const double rebound =
      std::abs(restitution - nominal) / (1 + nominal) / AffinityParameters().maxRelativeLinear;
  child.bend = std::sqrt(edge.bend * edge.bend + rebound * rebound);
  child.log.motion += logVelocity(child.bend);
  child.log.velocity += logVelocity(child.bend);
  if (child.bend > problem_.request.settings.bendCap) return;

  std::vector<ShootingNode> endings;
  for (const ContactEvent& event : outcomes_) {
    ShootingNode ending = child;
    ending.event = event;
    if (first) ending.firstAmplitude = event.amplitude;
    const double length = event.filteredDuration(problem_.recorder.mergeGap);
    ending.heard = {event.amplitude / ending.firstAmplitude, length,
                    length > 0 ? event.centroid : 0};
    ending.log.sound += logAmplitude(target, ending.heard) + logDuration(target, ending.heard) +
                        logCentroid(target, ending.heard);
    if (ending.log.total() > bound) endings.push_back(ending);
  }
  std::stable_sort(endings.begin(), endings.end(),
                   [](const auto& a, const auto& b) { return a.log.total() > b.log.total(); });
  if (endings.size() > kMostEndings) endings.resize(kMostEndings);
  for (ShootingNode& ending : endings) {
    ending.energyBefore = totalEnergy(problem_.model, ending.event.before);
    ending.energyAfter = totalEnergy(problem_.model, ending.event.after);
    judge(ending);
    children.push_back(ending);
  }
}

/// Ranks a motion by its score so far, the cost of the next step, and whether its energy suits what
/// follows.
void ShootingWorker::judge(ShootingNode& node) const {
  node.rank = node.log.total();
  const auto k = static_cast<std::size_t>(node.level);
  if (k + 1 >= problem_.targets.size()) return;
  node.rank -= lookAhead(node);
  EnergyOutlook::Features features = problem_.features[k];
  features[4] += portableLog(node.firstAmplitude);
  const double off = std::abs(problem_.outlook.deviation(node.energyAfter, features)) - 1;
  if (off > 0) node.rank -= problem_.settings.outlookWeight * off * off;
}

/// Log units that the motion would lose on its way to the next target with the smallest change that
/// flies there, or, where it does not just fly, by how far it misses that target unchanged.
double ShootingWorker::lookAhead(ShootingNode& node) const {
  const double hopeless = problem_.settings.hopeless;
  const double time =
      problem_.request.signature.events[static_cast<std::size_t>(node.level + 1)].time;
  const double duration = time - node.start - node.event.end;
  if (duration < shortestPassage()) return 2 * hopeless;
  const double flying = flightCost(node, duration);
  node.flightCost = flying;
  if (flying < 1) return flying;
  const auto next = simulation_.nextAudible(node.event.after, 2 * duration + 0.02);
  if (!next || !next->silentContact) return std::min(flying, hopeless);
  node.silentOff = std::abs(next->delay - duration) / std::max(0.01, 0.3 * duration);
  return std::min({hopeless, flying, 0.2 + node.silentOff * node.silentOff});
}

double ShootingWorker::flightCost(const ShootingNode& node, double duration) const {
  const double mostEnergy = node.energyBefore * (1 + problem_.request.settings.energyGain);
  const auto flight = timeFlight(problem_.model, node.event.after, regionOf(node.event),
                                 Coordinates::Zero(), duration, mostEnergy);
  if (!flight) return problem_.settings.hopeless;
  const bool allowed = flight->energy <= mostEnergy;
  const auto touch = firstTouch(problem_.model, flight->departure, duration + 1e-3);
  const bool clear = touch && std::abs(touch->time - duration) < kTouchPrecision;
  return -logVelocity(flight->bend) + (allowed ? 0 : 2) + (clear ? 0 : 2);
}

}  // namespace ifa
