// SPDX-License-Identifier: Apache-2.0
// A lane gets the same bits whatever its neighbours are: the kernel over one, four and eight lanes
// against the kernel over a double. Each test also looks whether neighbours did part: at branches,
// and in the number of sweeps that they need.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "dynamics/flight_path.h"
#include "dynamics/height_cubic.h"
#include "lane_cases.h"
#include "lane_numbers.h"

namespace ifa {
namespace {

using Counts = testing::Types<Pack<1>, Pack<4>, Pack<8>>;
TYPED_TEST_SUITE(Lanes, Counts);

TYPED_TEST(Lanes, FreeRotation) {
  using P = TypeParam;
  this->onEveryBody([&](const BodyModel& model, RandomStream& random, Parting& parting) {
    typename TestFixture::template Each<Spin<double>> start;
    Spin<P> starts;
    P times;
    for (std::size_t i = 0; i < start.size(); ++i) {
      start[i] = {randomTurn(random), randomVec(random, 30)};
      setLane(starts, i, start[i]);
      times.lanes[i] = random.uniform(0, closedForm(model) ? 5 : 0.02);
    }
    const Spin<P> ends = FreeRotation<P>(model, starts).at(times);
    for (std::size_t i = 0; i < start.size(); ++i) {
      const double turn = times.lanes[i] * start[i].w.x;
      expectLane(ends, i, FreeRotation<double>(model, start[i]).at(times.lanes[i]));
      expectLane(laneSinCos(times * starts.w.x), i, laneSinCos(turn));
      parting.add(static_cast<int>(turn));  // another quadrant
    }
  });
}

/// What a cubic is like, as firstTouch() asks.
int kindOf(const HeightCubic<double>& height) {
  const double touch = height.firstTouch();
  return (height.c1 > 0 ? 1 : 0) + (height.at(1) >= 0 ? 2 : 0) + (touch < 2 ? 4 : 0) +
         (touch > 0 ? 8 : 0) + (height.c2 > 0 ? 16 : 0);
}

TYPED_TEST(Lanes, FirstTouchOfAHeight) {
  using P = TypeParam;
  std::set<int> kinds;
  this->onEveryBody([&](const BodyModel&, RandomStream& random, Parting& parting) {
    std::array<P, 5> numbers;
    typename TestFixture::template Each<std::array<double, 5>> number;
    for (std::size_t i = 0; i < number.size(); ++i) {
      const double low = random.uniform() < 0.2 ? -0.1 : 0;
      number[i] = {random.uniform(low, 1), random.uniform(-5, 5), random.uniform(-1, 1),
                   random.uniform(-5, 5), random.uniform(0.5, 2)};
      for (std::size_t k = 0; k < 5; ++k) numbers[k].lanes[i] = number[i][k];
    }
    const HeightCubic<P> heights(numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]);
    const P touches = heights.firstTouch();
    for (std::size_t i = 0; i < number.size(); ++i) {
      const auto& n = number[i];
      const HeightCubic<double> height(n[0], n[1], n[2], n[3], n[4]);
      expectLane(touches, i, height.firstTouch());
      parting.add(kindOf(height));
      kinds.insert(kindOf(height));
    }
  });
  EXPECT_GT(kinds.size(), 12U);
}

TYPED_TEST(Lanes, FlightPath) {
  using P = TypeParam;
  this->onEveryBody([&](const BodyModel& model, RandomStream& random, Parting& parting) {
    typename TestFixture::template Each<KernelState<double>> start;
    typename TestFixture::template Each<Vec<double>> place;
    KernelState<P> starts;
    Vec<P> places;
    P longest, guess;
    for (std::size_t i = 0; i < start.size(); ++i) {
      start[i] = randomState(model, random);
      const auto vertex = static_cast<std::size_t>(random.below(model.x.size()));
      place[i] = {model.x[vertex], model.y[vertex], model.z[vertex]};
      setLane(starts, i, start[i]);
      setLane(places, i, place[i]);
      longest.lanes[i] = random.uniform(0.001, 0.1);
      guess.lanes[i] = random.uniform(0, 1);
    }
    const FlightPath<P> paths(model, starts);
    const P lengths = paths.length(longest);
    PathPoint<P> seens{};
    const P touches = paths.refined(guess * lengths, places, lengths, seens);
    for (std::size_t i = 0; i < start.size(); ++i) {
      const FlightPath<double> path(model, start[i]);
      const double length = path.length(longest.lanes[i]);
      PathPoint<double> seen{};
      const double touch = path.refined(guess.lanes[i] * length, place[i], length, seen);
      expectLane(lengths, i, length);
      expectLane(paths.bend(lengths), i, path.bend(length));
      expectLane(paths.at(lengths), i, path.at(length));
      expectLane(touches, i, touch);
      expectLane(seens.t, i, seen.t);
      expectLane(seens.state, i, seen.state);
      // Left alone at the first look, at the last one, or between.
      const bool first = touch == guess.lanes[i] * length;
      parting.add((first ? 1 : 0) + (touch == seen.t ? 2 : 0) +
                  (length < longest.lanes[i] ? 4 : 0));
    }
  });
}

/// One body in contact, for one lane.
struct Scene {
  KernelState<double> state;
  ContactSolver<double> solver;
};

/// The same for many.
template <class P>
struct Scenes {
  KernelState<P> state;
  ContactSolver<P> solver;

  std::vector<Scene> fill(const BodyModel& model, RandomStream& random) {
    std::vector<Scene> one(LaneTraits<P>::kLanes);
    for (std::size_t i = 0; i < one.size(); ++i) {
      one[i].state = randomState(model, random);
      one[i].solver = randomContact(model, one[i].state, random);
      setLane(state, i, one[i].state);
      setLane(solver, i, one[i].solver);
    }
    return one;
  }
};

constexpr int kSweeps = 40;

/// Velocities after at most `sweeps` sweeps; `solver` keeps the impulses.
template <class R>
Spin<R> solved(const BodyModel& model, const KernelState<R>& state, int sweeps,
               ContactSolver<R>& solver) {
  const Rotation<R> rotation(state.q);
  Vec<R> velocity = state.velocity, spin = rotation * state.w;
  solver.solve(model, WorldInertia<R>(model, rotation), sweeps, R(3e-4 * model.mass), velocity,
               spin);
  return {{R(0.0), velocity.x, velocity.y, velocity.z}, spin};
}

/// Sweeps until nothing changes any more.
int sweepsOf(const BodyModel& model, const Scene& scene) {
  ContactSolver<double> solver = scene.solver;
  const Spin<double> end = solved(model, scene.state, kSweeps, solver);
  for (int sweeps = 1; sweeps < kSweeps; ++sweeps) {
    solver = scene.solver;
    const Spin<double> now = solved(model, scene.state, sweeps, solver);
    if (now.q.x == end.q.x && now.q.z == end.q.z && now.w.x == end.w.x) return sweeps;
  }
  return kSweeps;
}

TYPED_TEST(Lanes, ContactSolver) {
  using P = TypeParam;
  this->onEveryBody([&](const BodyModel& model, RandomStream& random, Parting& parting) {
    Scenes<P> scenes;
    const std::vector<Scene> scene = scenes.fill(model, random);
    const Spin<P> ends = solved(model, scenes.state, kSweeps, scenes.solver);
    for (std::size_t i = 0; i < scene.size(); ++i) {
      ContactSolver<double> solver = scene[i].solver;
      expectLane(ends, i, solved(model, scene[i].state, kSweeps, solver));
      expectLane(scenes.solver, i, solver);
      expectLane(scenes.solver.total(), i, solver.total());
      expectLane(scenes.solver.totalTurn(), i, solver.totalTurn());
      parting.add(sweepsOf(model, scene[i]));
    }
  });
}

TYPED_TEST(Lanes, ImpactLaw) {
  using P = TypeParam;
  this->onEveryBody([&](const BodyModel& model, RandomStream& random, Parting& parting) {
    Scenes<P> scenes;
    std::vector<Scene> scene = scenes.fill(model, random);
    P restitution;
    for (double& lane : restitution.lanes) lane = random.uniform(0, 1);
    const Rotation<P> rotations(scenes.state.q);
    const ImpactLaw<P> laws(model, rotations, scenes.state.velocity, scenes.state.w);
    const Impact<P> afters = laws.solve(restitution, scenes.solver);
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const KernelState<double>& state = scene[i].state;
      const Rotation<double> rotation(state.q);
      const ImpactLaw<double> law(model, rotation, state.velocity, state.w);
      const Impact<double> after = law.solve(restitution.lanes[i], scene[i].solver);
      expectLane(afters, i, after);
      const double share = kineticEnergy(model, after.velocity, after.w) /
                           kineticEnergy(model, state.velocity, state.w);
      parting.add(share < 1 - 1e-12 ? 0 : 1);  // else it would have gained
    }
  });
}

TYPED_TEST(Lanes, MidpointStep) {
  using P = TypeParam;
  this->onEveryBody([&](const BodyModel& model, RandomStream& random, Parting& parting) {
    Scenes<P> scenes;
    std::vector<Scene> scene = scenes.fill(model, random);
    P step, energy0;
    for (std::size_t i = 0; i < scene.size(); ++i) {
      step.lanes[i] = random.uniform(1e-4, 2e-3);
      energy0.lanes[i] = totalEnergy(model, scene[i].state) * random.uniform(-0.5, 2);
    }
    KernelState<P> ends = scenes.state, halfways;
    Rotation<P> rotations(ends.q);
    const Midpoint<P> middles = solveMidpoint(model, ends, rotations, step, scenes.solver);
    moveByMidpoint(model, middles, step, ends, rotations);
    const P kinetics = spendGain(model, energy0, ends);
    const P rises = halveStep(model, scenes.state, energy0, ends, kinetics, step, halfways);
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const double h = step.lanes[i], energy = energy0.lanes[i];
      KernelState<double> end = scene[i].state, halfway;
      Rotation<double> rotation(end.q);
      const Midpoint<double> middle = solveMidpoint(model, end, rotation, h, scene[i].solver);
      moveByMidpoint(model, middle, h, end, rotation);
      const double full = totalEnergy(model, end), kinetic = spendGain(model, energy, end);
      const double rise = halveStep(model, scene[i].state, energy, end, kinetic, h, halfway);
      expectLane(middles, i, middle);
      expectLane(ends, i, end);
      expectLane(rotations, i, rotation);
      expectLane(kinetics, i, kinetic);
      expectLane(rises, i, rise);
      expectLane(halfways, i, halfway);
      parting.add(full <= energy ? 0 : (kinetic > 0 ? 1 : 2));
    }
  });
}

}  // namespace
}  // namespace ifa
