// SPDX-License-Identifier: Apache-2.0
// Drops per second, one thread: our kernel against ODE tuned as well as we could (Dantzig's solver,
// own vertex test, own rest test, 1 ms), restitution 0.5, friction 0.35, the same initial states.
// The answers are checked before anything is timed. --rolling adds the objects' rolling friction.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "body/object_file.h"
#include "dynamics/ode_backend.h"
#include "dynamics/simulator.h"
#include "dynamics/stepper.h"
#include "sampler/drop_statistics.h"
#include "sampler/initial_state.h"

namespace {

using ifa::Body;
using ifa::RigidState;

constexpr std::uint64_t kSeed = 77;
constexpr std::size_t kDrops = 300;
constexpr std::size_t kChecked = 500;
constexpr int kRounds = 9;
constexpr double kTimeLimit = 20;  // s
constexpr double kCountTolerance = 0.25;

struct Goal {
  std::string object;
  double ratio;
};

/// Rolling friction is left out unless asked for: ODE pays for three more rows per contact.
ifa::SurfaceProperties benchSurface(const Body& body, bool rolling) {
  ifa::SurfaceProperties surface = body.definition.surfaces.at(body.definition.defaultSurface);
  if (!rolling) surface.rollingFriction = surface.spinningFriction = 0;
  surface.restitution = 0.5;
  surface.friction = 0.35;
  return surface;
}

/// The kernel without a record of its steps, as ODE runs here too. True when at rest.
bool dropNative(const ifa::BodyModel& model, const RigidState& start) {
  ifa::Stepper stepper(model);
  stepper.start(ifa::kernelState(start, 0));
  while (stepper.state().time < kTimeLimit) {
    if (stepper.advance(kTimeLimit) == ifa::Advance::kRest) return true;
  }
  return false;
}

bool dropOde(const Body& body, const ifa::SurfaceProperties& surface, const RigidState& start) {
  ifa::OdeSettings settings;
  settings.recordSteps = false;
  return ifa::simulateDropOde(body, surface, start, kTimeLimit, settings).atRest;
}

/// Both come to rest, with about as many events.
bool answersAgree(const Body& body, const ifa::SurfaceProperties& surface) {
  const ifa::BodyModel model(body, surface);
  const auto native = ifa::gatherStatistics(
      body, surface, [&](const auto& s) { return ifa::simulateDrop(model, s, kTimeLimit); }, kSeed,
      kChecked);
  const auto ode = ifa::gatherStatistics(
      body, surface,
      [&](const auto& s) { return ifa::simulateDropOde(body, surface, s, kTimeLimit); }, kSeed,
      kChecked);
  const double ours = ifa::mean(native.paperEvents), theirs = ifa::mean(ode.paperEvents);
  fmt::print("{:<10} events per drop {:.2f}, ODE {:.2f}; not at rest {}, ODE {}\n",
             body.definition.name, ours, theirs, native.unfinished, ode.unfinished);
  return native.unfinished == 0 && ode.unfinished == 0 &&
         std::abs(ours / theirs - 1) <= kCountTolerance;
}

double dropsPerSecond(const std::vector<RigidState>& starts,
                      const std::function<bool(const RigidState&)>& drop) {
  // Processor time: what else the machine does must not count.
  const std::clock_t begin = std::clock();
  std::size_t rested = 0;
  for (const RigidState& start : starts) rested += drop(start) ? 1 : 0;
  const double spent = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return rested == starts.size() ? static_cast<double>(rested) / spent : 0;
}

bool run(const Goal& goal, bool rolling) {
  const auto body = ifa::loadObject(goal.object);
  if (!body) {
    fmt::print(stderr, "{}\n", body.error().text());
    return false;
  }
  const ifa::SurfaceProperties surface = benchSurface(*body, rolling);
  if (!answersAgree(*body, surface)) {
    fmt::print("{:<10} the answers do not agree: not timed\n", goal.object);
    return false;
  }
  const ifa::BodyModel model(*body, surface);
  std::vector<RigidState> starts;
  for (std::size_t i = 0; i < kDrops; ++i)
    starts.push_back(ifa::sampleInitialState(*body, kSeed, i));
  std::vector<double> native, ode, ratios;
  for (int round = 0; round < kRounds; ++round) {
    ode.push_back(
        dropsPerSecond(starts, [&](const auto& s) { return dropOde(*body, surface, s); }));
    native.push_back(dropsPerSecond(starts, [&](const auto& s) { return dropNative(model, s); }));
    ratios.push_back(native.back() / ode.back());
  }
  const double ratio = ifa::median(ratios);
  fmt::print("{:<10} {:8.0f} drops/s, ODE {:6.0f}: {:5.1f} times (at least {} wanted)\n",
             goal.object, ifa::median(native), ifa::median(ode), ratio, goal.ratio);
  std::fflush(stdout);
  return ratio >= goal.ratio;
}

}  // namespace

int main(int argc, char** argv) {
  const bool rolling = argc > 1 && std::string(argv[1]) == "--rolling";
  ifa::setThreadCount(1);
  bool met = true;
  for (const Goal& goal : {Goal{"d6", 7}, Goal{"d20", 8}, Goal{"CoffeeCup", 8}})
    met = run(goal, rolling) && met;
  return met ? EXIT_SUCCESS : EXIT_FAILURE;
}
