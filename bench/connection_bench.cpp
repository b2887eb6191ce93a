// SPDX-License-Identifier: Apache-2.0
// Connections between neighbouring contacts of simulated drops: how many can be made, how many
// Newton steps and microseconds they take, how far they bend the contacts, one thread. Every
// connection made is flown again by Runge and Kutta before anything is timed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "affinity/factors.h"
#include "base/parallel.h"
#include "base/random.h"
#include "body/object_file.h"
#include "connection/connection.h"
#include "dynamics/simulator.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using ifa::Body;
using ifa::BodyModel;
using ifa::ConnectionFailure;
using ifa::ConnectionSettings;
using ifa::ContactEvent;

constexpr std::uint64_t kSeed = 4711;
constexpr std::size_t kDrops = 20000, kSources = 1000, kNeighbours = 5;
constexpr double kLeastLog = -10;     // of f_v and of f_q: what the paper explores (5.5)
constexpr double kTimeLimit = 20;     // s
constexpr double kRightAngle = 1e-5;  // rad, against Runge and Kutta

/// A contact with the one that follows it after a flight.
struct Passage {
  std::size_t drop;
  ContactEvent first, next;
  ifa::PlanarKey key;
};

/// Two passages to be joined: the first's contact with the second's next.
struct Pair {
  const Passage *source, *neighbour;
  double target;  ///< T*, s
};

std::vector<Passage> simulate(const Body& body, const BodyModel& model) {
  std::vector<std::vector<Passage>> drops(kDrops);
  ifa::parallelFor(kDrops, [&](std::size_t d) {
    const auto start = ifa::sampleInitialState(body, kSeed, d);
    const auto events = ifa::eventsOf(ifa::simulateDrop(model, start, kTimeLimit),
                                      ifa::audibleCut(body, model.surface));
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {
      if (events[i].touchingAfter) continue;
      drops[d].push_back({d, events[i], events[i + 1], ifa::planarKey(events[i].after)});
    }
  });
  std::vector<Passage> all;
  for (const auto& drop : drops) all.insert(all.end(), drop.begin(), drop.end());
  return all;
}

double timeOf(const Passage& p) { return p.next.start - p.first.end; }

/// The neighbours that equations 3 to 5 rank best, as seen from the bodies.
std::vector<const Passage*> neighboursOf(const Passage& source, double target,
                                         const std::vector<Passage>& all, double radius) {
  const Quaterniond inverse = source.first.after.orientation.conjugate();
  const ifa::PlausibleRegion region(
      inverse * (source.first.after.velocity - source.first.before.velocity),
      inverse * (source.first.after.angularVelocity - source.first.before.angularVelocity), radius);
  std::vector<std::pair<double, std::size_t>> ranked;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Passage& other = all[i];
    if (other.drop == source.drop) continue;
    const double velocity =
        ifa::logVelocity(region.bend(source.key.velocity - other.key.velocity,
                                     source.key.angularVelocity - other.key.angularVelocity));
    const double turn =
        ifa::logOrientation(ifa::angleBetween(source.key, other.key), timeOf(other));
    const double warp = ifa::logTimeWarp(target, timeOf(other));
    if (velocity < kLeastLog || turn < kLeastLog || warp < kLeastLog) continue;
    ranked.emplace_back(-velocity - turn - warp, i);
  }
  const std::size_t count = std::min(kNeighbours, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count),
                    ranked.end());
  std::vector<const Passage*> best;
  for (std::size_t n = 0; n < count; ++n) best.push_back(&all[ranked[n].second]);
  return best;
}

std::vector<Pair> neighbourPairs(const std::vector<Passage>& all, double radius) {
  std::vector<std::vector<Pair>> found(kSources);
  ifa::parallelFor(kSources, [&](std::size_t s) {
    ifa::RandomStream random(kSeed, s);
    const Passage& source = all[random.below(all.size())];
    const double target = timeOf(source) * random.uniform(0.85, 1.15);
    for (const Passage* other : neighboursOf(source, target, all, radius))
      found[s].push_back({&source, other, target});
  });
  std::vector<Pair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

ifa::Connection join(const BodyModel& model, const Pair& pair, const ConnectionSettings& settings) {
  return ifa::connect(
      model, ifa::connectionEnds(pair.source->first, pair.neighbour->first, pair.neighbour->next),
      pair.target, settings);
}

/// Orientation after a flight with constant angular momentum, by Runge and Kutta. The moments are
/// the model's: it takes two that differ by less than 1e-6 for equal, as the Nut's do, and a flight
/// of many turns shows even that.
Quaterniond flown(const BodyModel& model, const ifa::RigidState& start, double duration) {
  const Vector3d moments(model.inertia.x, model.inertia.y, model.inertia.z);
  const Eigen::Matrix3d axes(start.orientation);
  const Vector3d momentum = axes * moments.asDiagonal() * axes.transpose() * start.angularVelocity;
  const auto rate = [&](const Eigen::Vector4d& c) -> Eigen::Vector4d {
    const Quaterniond q = Quaterniond(c).normalized();
    const Vector3d w = q * (q.conjugate() * momentum).cwiseQuotient(moments).eval();
    return 0.5 * (Quaterniond(0, w.x(), w.y(), w.z()) * q).coeffs();
  };
  Eigen::Vector4d q = start.orientation.coeffs();
  const int steps = static_cast<int>(duration * start.angularVelocity.norm() / 0.005) + 1;
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector4d a = rate(q), b = rate(q + h / 2 * a), c = rate(q + h / 2 * b),
                          d = rate(q + h * c);
    q = (q + h / 6 * (a + 2 * b + 2 * c + d)).normalized();
  }
  return Quaterniond(q);
}

double angle(const Quaterniond& a, const Quaterniond& b) {
  return 2 * std::asin(std::min(1.0, (a.conjugate() * b).vec().norm()));
}

/// Bend of a contact whose velocities before or after it are changed.
double bendOf(const ContactEvent& event, const Vector3d& linear, const Vector3d& angular,
              double radius) {
  const Vector3d dv = event.after.velocity - event.before.velocity;
  const Vector3d dw = event.after.angularVelocity - event.before.angularVelocity;
  return ifa::PlausibleRegion(dv, dw, radius).bend(linear, angular);
}

struct Figures {
  std::map<ConnectionFailure, int> outcomes;
  std::vector<double> steps, leaving, arriving;
  double worstAngle = 0;
};

Figures measure(const Body& body, const BodyModel& model, const std::vector<Pair>& pairs,
                const ConnectionSettings& settings) {
  Figures figures;
  for (const Pair& pair : pairs) {
    const ifa::Connection c = join(model, pair, settings);
    ++figures.outcomes[c.failure];
    const bool shot = c.made() || c.failure == ConnectionFailure::kUnderGround;
    if (!shot) continue;
    figures.steps.push_back(c.steps);
    figures.worstAngle =
        std::max(figures.worstAngle,
                 angle(flown(model, c.departure, c.time.flightTime), c.target.orientation));
    if (!c.made()) continue;
    const ifa::RigidState& own = pair.source->first.after;
    figures.leaving.push_back(bendOf(pair.source->first, c.departure.velocity - own.velocity,
                                     c.departure.angularVelocity - own.angularVelocity,
                                     body.radius));
    const Quaterniond back = c.registration.transform.turn().conjugate();
    figures.arriving.push_back(
        bendOf(pair.neighbour->next, back * (c.arrival.velocity - c.target.velocity),
               back * (c.arrival.angularVelocity - c.target.angularVelocity), body.radius));
  }
  return figures;
}

double microseconds(const BodyModel& model, const std::vector<Pair>& pairs,
                    const ConnectionSettings& settings) {
  std::vector<double> rounds;
  double keep = 0;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t begin = std::clock();
    for (const Pair& pair : pairs) keep += join(model, pair, settings).missed;
    rounds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC * 1e6 /
                     static_cast<double>(pairs.size()));
  }
  return keep < 0 ? 0 : ifa::median(rounds);
}

struct Way {
  const char* name;
  ConnectionSettings settings;
};

std::vector<Way> ways(double depth) {
  ConnectionSettings exact, departure, wide, printed = ConnectionSettings::printed();
  ConnectionSettings vector = printed;
  vector.shooting = wide.shooting;
  exact.registerAt = ifa::RegisterAt::kArrival;
  exact.shooting.largestTurn = printed.shooting.largestTurn;
  departure.shooting.largestTurn = printed.shooting.largestTurn;
  std::vector<Way> all = {{"exact, at arrival", exact},
                          {"exact, at departure", departure},
                          {"the same, 30 degrees", wide},
                          {"printed", printed},
                          {"printed, vector", vector}};
  for (Way& way : all) way.settings.depth = depth;
  return all;
}

bool run(const std::string& object) {
  const auto body = ifa::loadObject(object);
  if (!body) {
    fmt::print(stderr, "{}\n", body.error().text());
    return false;
  }
  const BodyModel model(*body, body->definition.surfaces.at(body->definition.defaultSurface));
  const auto passages = simulate(*body, model);
  const auto pairs = neighbourPairs(passages, body->radius);
  fmt::print("{}: {} passages, {} pairs\n", object, passages.size(), pairs.size());
  bool good = true;
  for (const auto& [name, settings] : ways(body->tolerance())) {
    Figures f = measure(*body, model, pairs, settings);
    good = good && f.worstAngle < kRightAngle;
    const double all = static_cast<double>(pairs.size());
    const auto share = [&](ConnectionFailure why) { return 100 * f.outcomes[why] / all; };
    fmt::print(
        "  {:<21} made {:5.1f} %, no spin {:.2f} %, under ground {:4.1f} %, warp {:4.1f} %; steps "
        "{:4.1f} mean {:2.0f} most; bend {:5.2f} leaving {:5.2f} arriving; {:6.1f} us; RK4 "
        "{:.0e}\n",
        name, share(ConnectionFailure::kNone), share(ConnectionFailure::kNotConverged),
        share(ConnectionFailure::kUnderGround), share(ConnectionFailure::kTimeWarp),
        ifa::mean(f.steps), f.steps.empty() ? 0 : *std::max_element(f.steps.begin(), f.steps.end()),
        ifa::median(f.leaving), ifa::median(f.arriving), microseconds(model, pairs, settings),
        f.worstAngle);
    std::fflush(stdout);
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> objects(argv + 1, argv + argc);
  if (objects.empty()) objects = {"d6", "d10", "Nut", "Eraser", "Lego2x2", "CoffeeCup"};
  bool good = true;
  for (const std::string& object : objects) good = run(object) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
