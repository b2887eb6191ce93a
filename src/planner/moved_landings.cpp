// SPDX-License-Identifier: Apache-2.0
#include "planner/moved_landings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dynamics/energy.h"

namespace ifa {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// How far the contact is moved, in units of what makes a take different from this one: others have
/// to differ from each other as well.
constexpr std::array kReaches = {1.1, 1.4, 1.8, 2.4, 3.2};
/// Half of sixteen ways to go.
constexpr double kC1 = 0.92387953251128674, kC2 = 0.70710678118654752, kC3 = 0.38268343236508977;
constexpr std::array<std::array<double, 2>, 8> kWays = {
    {{1, 0}, {kC1, kC3}, {kC2, kC2}, {kC3, kC1}, {0, 1}, {-kC3, kC1}, {-kC2, kC2}, {-kC1, kC3}}};
/// A flight that would do less of the work is left alone.
constexpr double kLeastShare = 0.02;
/// A contact that bends much is eased by so much, and so often.
constexpr double kEasing = 0.6;
constexpr int kMostTries = 10;
/// Contacts that are moved, of each way to go.
constexpr std::size_t kPointsPerWay = 20;

Vector3d level(const Vector2d& v) { return {v.x(), v.y(), 0}; }

Vector2d across(const Vector2d& v) { return {-v.y(), v.x()}; }

}  // namespace

MovedLandings::SquaredBend::SquaredBend(const PlannedContact& contact,
                                        const PlausibleRegion& region, const Vector3d& linear,
                                        const Vector3d& angular) {
  const Coordinates now = region.coordinates(linear, angular);
  Eigen::Matrix<double, 6, 2> by;
  for (int axis = 0; axis < 2; ++axis) {
    by.col(axis) =
        region.coordinates(contact.placement.directionFrom(Vector3d::Unit(axis)), Vector3d::Zero());
  }
  bend = now.squaredNorm();
  slope = by.transpose() * now;
  curvature = by.transpose() * by;
}

MovedLandings::MovedLandings(const ShootingProblem& problem, Plan plan)
    : problem_(problem), plan_(std::move(plan)), path_(pathOf(plan_)) {
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = 0; i < path_.size(); ++i) {
    mean += path_[i] / static_cast<double>(path_.size());
    if (i > 0) length_ += (path_[i] - path_[i - 1]).norm();
  }
  for (Vector2d& point : path_) {
    point -= mean;
    spread_ += point.squaredNorm();
  }
  for (std::size_t k = 0; k + 1 < plan_.contacts.size(); ++k) addFlight(k);
  for (const PlannedContact& contact : plan_.contacts) losses_.push_back(lossOf(contact));
}

PlausibleRegion MovedLandings::regionOf(const PlannedContact& contact) const {
  return {contact.event.after.velocity - contact.event.before.velocity,
          contact.event.after.angularVelocity - contact.event.before.angularVelocity,
          problem_.model.radius};
}

void MovedLandings::addFlight(std::size_t k) {
  const PlannedContact &from = plan_.contacts[k], &to = plan_.contacts[k + 1];
  Flight flight;
  flight.time = (to.time - from.time - from.event.end) / to.retiming;
  const Vector3d velocity = from.event.after.velocity + from.velocityChange;
  flight.velocity = from.placement.direction(velocity).head<2>();
  flight.leaving = {from, regionOf(from), from.velocityChange, from.angularVelocityChange};
  // What the contact makes up for is what the body does not bring along.
  flight.reaching = {to, regionOf(to), -to.arrivalChange, -to.arrivalAngularChange};
  flight.rebound = std::max(0.0, to.bend * to.bend - flight.leaving.bend);
  const Matrix2d cost = flight.leaving.curvature + flight.reaching.curvature;
  const double squaredTime = flight.time * flight.time;
  flight.ease = squaredTime * cost.inverse();
  const Vector2d side = across(flight.velocity);
  flight.sideways = squaredTime / side.dot(cost * side) * side * side.transpose();
  const bool flies = to.arrival == Arrival::kFlight && flight.time > 0;
  flight.free = flies && flight.ease.allFinite() && flight.sideways.allFinite();
  flights_.push_back(flight);
}

/// With what the body arrives, and with what it leaves again.
RigidState MovedLandings::arrivalOf(const PlannedContact& contact) {
  RigidState state = contact.event.before;
  state.velocity -= contact.arrivalChange;
  state.angularVelocity -= contact.arrivalAngularChange;
  return state;
}

RigidState MovedLandings::departureOf(const PlannedContact& contact) {
  RigidState state = contact.event.after;
  state.velocity += contact.velocityChange;
  state.angularVelocity += contact.angularVelocityChange;
  return state;
}

MovedLandings::Loss MovedLandings::lossOf(const PlannedContact& contact) const {
  const double arrival = totalEnergy(problem_.model, arrivalOf(contact));
  const double allowed = arrival * (1 + problem_.request.settings.energyGain);
  return {arrival - totalEnergy(problem_.model, contact.event.after),
          allowed - totalEnergy(problem_.model, departureOf(contact))};
}

/// By how much the point goes that way, after the best registration, for each metre that a flight
/// goes farther.
std::vector<Vector2d> MovedLandings::pullsOn(std::size_t point, const Vector2d& way) const {
  const double count = static_cast<double>(path_.size());
  const double turning = spread_ > 0 ? across(path_[point]).dot(way) / spread_ : 0;
  std::vector<Vector2d> pulls(flights_.size());
  Vector2d sum = Vector2d::Zero();
  // A flight moves all contacts after it, the last one and the end alike.
  for (std::size_t i = path_.size() - 1; i > 0; --i) {
    sum += ((i == point ? 1.0 : 0.0) - 1 / count) * way - turning * across(path_[i]);
    if (i - 1 < pulls.size()) pulls[i - 1] = sum;
  }
  return pulls;
}

/// The cheapest flights that move the point so far; none where no flight can.
std::vector<Vector2d> MovedLandings::cheapest(const std::vector<Vector2d>& pulls,
                                              const std::vector<Freedom>& freedoms,
                                              double distance) const {
  std::vector<Vector2d> farther;
  std::vector<double> work;
  double all = 0, kept = 0;
  for (std::size_t k = 0; k < flights_.size(); ++k) {
    const Matrix2d& ease = freedoms[k].sideways ? flights_[k].sideways : flights_[k].ease;
    farther.emplace_back(freedoms[k].share * (ease * pulls[k]));
    work.push_back(pulls[k].dot(farther[k]));
    all += work[k];
  }
  for (std::size_t k = 0; k < flights_.size(); ++k) {
    if (work[k] < kLeastShare * all) farther[k].setZero();
    kept += farther[k].dot(pulls[k]);
  }
  if (!(kept > 0)) return {};
  for (Vector2d& flight : farther) flight *= distance / kept;
  return farther;
}

/// Begins with the least sum of squares, and takes from flights that have not got the energy, or
/// that bend much, until the motion is worth no more for it.
void MovedLandings::propose(const std::vector<Vector2d>& pulls, double distance,
                            std::vector<MovedLanding>& out) const {
  std::vector<Freedom> freedoms;
  for (const Flight& flight : flights_) freedoms.push_back({flight.free ? 1.0 : 0.0, false});
  std::optional<MovedLanding> best;
  for (int tries = 0; tries < kMostTries; ++tries) {
    std::vector<Vector2d> farther = cheapest(pulls, freedoms, distance);
    if (farther.empty()) break;
    if (const auto flight = overdrawn(farther)) {
      Freedom& freedom = freedoms[*flight];
      freedom = {freedom.sideways ? 0.0 : freedom.share, true};
      continue;
    }
    const Bent bent = bendsOf(farther);
    if (bent.most <= problem_.request.settings.bendCap) {
      if (best && best->worth >= bent.worth) break;
      best = {std::move(farther), bent.worth};
    }
    if (bent.most <= problem_.settings.largeBend) break;
    freedoms[bent.flight].share *= kEasing;
  }
  if (best) out.push_back(std::move(*best));
}

/// A flight on which energy would have to come out of nothing. What a contact would have to give
/// back to the arriving body, or the next flight would need more of, is missing.
std::optional<std::size_t> MovedLandings::overdrawn(const std::vector<Vector2d>& farther) const {
  const auto gained = [&](std::size_t k) {
    const Vector2d added = farther[k] / flights_[k].time;
    return problem_.model.mass * added.dot(flights_[k].velocity + 0.5 * added);
  };
  for (std::size_t i = 0; i < losses_.size(); ++i) {
    const bool comes = i > 0 && !farther[i - 1].isZero(0);
    const bool goes = i < farther.size() && !farther[i].isZero(0);
    const double brought = comes ? gained(i - 1) : 0;
    if (comes && losses_[i].simulated + brought < 0) return i - 1;
    if ((comes || goes) && losses_[i].whole + brought - (goes ? gained(i) : 0) < 0) {
      return goes ? i : i - 1;
    }
  }
  return {};
}

std::vector<MovedLanding> MovedLandings::proposals() const {
  std::vector<MovedLanding> all;
  for (const auto& [x, y] : kWays) {
    std::vector<std::pair<double, std::vector<Vector2d>>> points;  // the easiest to move first
    for (std::size_t point = 0; point < path_.size(); ++point) {
      std::vector<Vector2d> pulls = pullsOn(point, {x, y});
      double ease = 0;
      for (std::size_t k = 0; k < flights_.size(); ++k) {
        if (flights_[k].free) ease += pulls[k].dot(flights_[k].ease * pulls[k]);
      }
      points.emplace_back(ease, std::move(pulls));
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    points.resize(std::min(points.size(), kPointsPerWay));
    for (const auto& [ease, pulls] : points) {
      for (const double reach : kReaches) {
        propose(pulls, reach * kDifferentShare * length_, all);
        propose(pulls, -reach * kDifferentShare * length_, all);
      }
    }
  }
  return all;
}

double MovedLandings::costOf(double squaredBend) const {
  const double large = std::max(0.0, std::sqrt(squaredBend) - problem_.settings.largeBend);
  return -logVelocity(std::sqrt(squaredBend)) + problem_.settings.bendAversion * large * large;
}

MovedLandings::Bent MovedLandings::bendsOf(const std::vector<Vector2d>& farther) const {
  Bent bent{plan_.worth, 0, 0};
  for (std::size_t k = 0; k < farther.size(); ++k) {
    if (farther[k].isZero(0)) continue;
    const Flight& flight = flights_[k];
    const Vector2d added = farther[k] / flight.time;
    const double leaving = flight.leaving.at(added) + flight.rebound;
    const double reaching = flight.reaching.at(added);
    bent.worth -= costOf(leaving) - costOf(flight.leaving.bend + flight.rebound);
    bent.worth -= costOf(reaching) - costOf(flight.reaching.bend);
    const double most = std::sqrt(std::max(leaving, reaching));
    if (most > bent.most) {
      bent.most = most;
      bent.flight = k;
    }
  }
  return bent;
}

void MovedLandings::apply(std::size_t k, const Vector2d& farther, Plan& plan) const {
  const Flight& flight = flights_[k];
  const Vector2d added = farther / flight.time;
  PlannedContact &from = plan.contacts[k], &to = plan.contacts[k + 1];
  from.velocityChange += from.placement.directionFrom(level(added));
  to.arrivalChange -= to.placement.directionFrom(level(added));
  to.bend = std::sqrt(std::max(0.0, flight.leaving.at(added) + flight.rebound));
  to.arrivalBend = regionOf(to).bend(to.arrivalChange, to.arrivalAngularChange);
  to.factors.v = std::exp(logVelocity(to.bend) + logVelocity(to.arrivalBend));
  for (std::size_t i = k + 1; i < plan.contacts.size(); ++i) {
    plan.contacts[i].placement.plane.x += farther.x();
    plan.contacts[i].placement.plane.y += farther.y();
  }
}

/// Whether the contact can be made, and left, like this: as ShootingWorker asks it.
bool MovedLandings::holds(const PlannedContact& contact) const {
  const Loss loss = lossOf(contact);
  if (loss.whole < 0) return false;
  if (contact.arrivalChange.isZero(0) && contact.arrivalAngularChange.isZero(0)) return true;
  const RigidState arrival = arrivalOf(contact);
  const ContactBeginning beginning =
      beginningOf(problem_.model, contact.event.before, contact.restitution, contact.event.end);
  return loss.simulated >= 0 && canBegin(problem_.model, problem_.recorder, beginning,
                                         totalEnergy(problem_.model, arrival), arrival.velocity,
                                         problem_.request.body->tolerance());
}

std::optional<Plan> MovedLandings::moved(const MovedLanding& landing) const {
  Plan plan = plan_;
  plan.solved = false;
  const auto n = static_cast<double>(plan.contacts.size());
  LogScore log;
  log.motion = 3 * n * std::log(plan.scoreWithoutSound);
  log.velocity = n * std::log(plan.meanFv);
  log.sound = 6 * n * std::log(plan.score) - log.motion;
  for (std::size_t k = 0; k < flights_.size(); ++k) {
    if (landing.farther[k].isZero(0)) continue;
    const double before = std::log(plan.contacts[k + 1].factors.v);
    apply(k, landing.farther[k], plan);
    const double change = std::log(plan.contacts[k + 1].factors.v) - before;
    log.motion += change;
    log.velocity += change;
  }
  for (const PlannedContact& contact : plan.contacts) {
    if (!holds(contact)) return {};
  }
  plan.worth = landing.worth;
  sumUp(plan, log);
  return plan;
}

}  // namespace ifa
