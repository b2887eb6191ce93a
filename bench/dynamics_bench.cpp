// SPDX-License-Identifier: Apache-2.0
// Drops per second and core (one thread): our kernel, one simulation at a time and many side by
// side in the lanes of each instruction set, against ODE tuned as well as we could (Dantzig's
// solver, own vertex test, own rest test, 1 ms), restitution 0.5, friction 0.35, the same initial
// states. All in double precision. The answers are checked before anything is timed. --rolling adds
// the objects' rolling friction.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "body/object_file.h"
#include "dynamics/batch_stepper.h"
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
constexpr std::size_t kManyDrops = 3000;  // side by side: the last ones leave lanes empty
constexpr std::size_t kChecked = 500;
constexpr int kRounds = 9;
constexpr double kTimeLimit = 20;  // s
constexpr double kCountTolerance = 0.25;

struct Goal {
  std::string object;
  double one, many;  ///< times ODE
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

/// Drops every start in one batch; the states at the end are those of dropNative().
class DropMany : public ifa::BatchListener {
 public:
  DropMany(const ifa::BodyModel& model, const std::vector<RigidState>& starts)
      : starts_(starts), ends_(starts.size()), drops_(ifa::BatchStepper::kPlaces), batch_(model) {
    for (std::size_t place = 0; place < drops_.size(); ++place) startNext(place);
    batch_.run(kTimeLimit, *this);
  }
  bool hear(ifa::BatchStepper&, std::size_t place, const ifa::Piece& piece) override {
    const bool rests = piece.did == ifa::Advance::kRest;
    if (!rests && piece.state.time < kTimeLimit) return true;
    if (rests) ++rested_;
    ends_[drops_[place]] = piece.state;
    return startNext(place);
  }
  [[nodiscard]] std::size_t rested() const { return rested_; }
  [[nodiscard]] const std::vector<ifa::KernelState<double>>& ends() const { return ends_; }

 private:
  bool startNext(std::size_t place) {
    if (next_ == starts_.size()) return false;
    drops_[place] = next_;
    batch_.start(place, ifa::kernelState(starts_[next_++], 0));
    return true;
  }

  const std::vector<RigidState>& starts_;
  std::vector<ifa::KernelState<double>> ends_;
  std::vector<std::size_t> drops_;  ///< in each place
  std::size_t next_ = 0, rested_ = 0;
  ifa::BatchStepper batch_;
};

/// The batch ends every drop where the drop by itself ends, to the bit.
bool sameBits(const ifa::BodyModel& model, const std::vector<RigidState>& starts) {
  for (const std::string& name : ifa::instructionSets()) {
    ifa::useInstructionSet(name);
    const DropMany many(model, starts);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      ifa::Stepper stepper(model);
      stepper.start(ifa::kernelState(starts[i], 0));
      while (stepper.state().time < kTimeLimit &&
             stepper.advance(kTimeLimit) != ifa::Advance::kRest) {
      }
      if (std::memcmp(&stepper.state(), &many.ends()[i], sizeof many.ends()[i]) != 0) return false;
    }
  }
  return true;
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

/// @param drop  returns how many of the starts came to rest
double dropsPerSecond(std::size_t count, const std::function<std::size_t()>& drop) {
  // Processor time: what else the machine does must not count.
  const std::clock_t begin = std::clock();
  const std::size_t rested = drop();
  const double spent = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return rested == count ? static_cast<double>(rested) / spent : 0;
}

/// A way to simulate, its speed in each round and its share of ODE's in the same round.
struct Way {
  std::string name;
  double goal;
  std::vector<double> speeds, ratios;
};

bool report(const std::string& object, const Way& way) {
  const double ratio = ifa::median(way.ratios);
  const std::string goal = way.goal > 0 ? fmt::format(" (at least {} wanted)", way.goal) : "";
  fmt::print("{:<10} {:<9} {:8.0f} drops/s, {:5.1f} times ODE{}\n", object, way.name,
             ifa::median(way.speeds), ratio, goal);
  std::fflush(stdout);
  return ratio >= way.goal;
}

bool time(const Body& body, const ifa::SurfaceProperties& surface, const Goal& goal) {
  const ifa::BodyModel model(body, surface);
  std::vector<RigidState> starts;
  for (std::size_t i = 0; i < kManyDrops; ++i) {
    starts.push_back(ifa::sampleInitialState(body, kSeed, i));
  }
  const std::vector<RigidState> few(starts.begin(), starts.begin() + kDrops);
  if (!sameBits(model, few)) {
    fmt::print("{:<10} many lanes have other bits: not timed\n", goal.object);
    return false;
  }
  std::vector<Way> ways = {{"ODE", 0, {}, {}}, {"one lane", goal.one, {}, {}}};
  // The best instruction set has to meet the goal.
  for (const std::string& name : ifa::instructionSets()) {
    ways.push_back({name, ways.size() == 2 ? goal.many : 0, {}, {}});
  }
  const auto each = [&](const auto& drop) {
    return static_cast<std::size_t>(std::count_if(few.begin(), few.end(), drop));
  };
  for (int round = 0; round < kRounds; ++round) {
    for (Way& way : ways) {
      if (way.name == "ODE") {
        way.speeds.push_back(dropsPerSecond(kDrops, [&] {
          return each([&](const auto& s) { return dropOde(body, surface, s); });
        }));
      } else if (way.name == "one lane") {
        way.speeds.push_back(dropsPerSecond(
            kDrops, [&] { return each([&](const auto& s) { return dropNative(model, s); }); }));
      } else {
        ifa::useInstructionSet(way.name);
        way.speeds.push_back(
            dropsPerSecond(kManyDrops, [&] { return DropMany(model, starts).rested(); }));
      }
      way.ratios.push_back(way.speeds.back() / ways[0].speeds.back());
    }
  }
  bool met = true;
  for (const Way& way : ways) met = report(goal.object, way) && met;
  return met;
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
  return time(*body, surface, goal);
}

}  // namespace

int main(int argc, char** argv) {
  const bool rolling = argc > 1 && std::string(argv[1]) == "--rolling";
  ifa::setThreadCount(1);
  bool met = true;
  for (const Goal& goal : {Goal{"d6", 7, 25}, Goal{"d20", 8, 25}, Goal{"CoffeeCup", 8, 20}})
    met = run(goal, rolling) && met;
  return met ? EXIT_SUCCESS : EXIT_FAILURE;
}
