// SPDX-License-Identifier: Apache-2.0
// The same start gives the same bits, whoever runs it: replays rely on it.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "kernel_drops.h"
#include "sampler/initial_state.h"
#include "support/box_body.h"

namespace ifa {
namespace {

constexpr std::size_t kDrops = 30;

/// Drops of a die, a box and a prism, every state of each told.
std::uint64_t hashOfDrop(const BodyModel& model, const RigidState& start) {
  Stepper stepper(model);
  stepper.start(kernelState(start, 0));
  std::uint64_t hash = 14695981039346656037ULL;
  while (stepper.state().time < 20) {
    const Advance did = stepper.advance(Stepper::kNoLimit);
    hash = hashState(stepper.state(), hash);
    if (did == Advance::kRest) break;
  }
  return hash;
}

SurfaceProperties lively() {
  SurfaceProperties surface;
  surface.restitution = 0.7;
  surface.rollingFriction = surface.spinningFriction = 2e-4;
  return surface;
}

/// Exact in binary, so that no library rounds them.
RigidState exactStart(int i) {
  RigidState state;
  state.position.z() = 0.25;
  state.velocity = {0.5, 0.125 * i, -1};
  state.angularVelocity = {4.0 + i, -8, 2.5 * i};
  return state;
}

TEST(KernelBits, DoNotDependOnThreads) {
  const Body prism = makePrismBody(24, 0.03, 0.05, 0.1);
  const BodyModel model(prism, lively());
  std::vector<std::uint64_t> alone(kDrops), first(kDrops), second(kDrops);
  const auto run = [&](std::vector<std::uint64_t>& hashes) {
    for (std::size_t i = 0; i < kDrops; ++i)
      hashes[i] = hashOfDrop(model, sampleInitialState(prism, 3, i));
  };
  run(alone);
  std::thread other([&] { run(first); });
  run(second);
  other.join();
  EXPECT_EQ(alone, first);
  EXPECT_EQ(alone, second);
}

TEST(KernelBits, AStepperThatRanBeforeStartsAfresh) {
  const Body prism = makePrismBody(24, 0.03, 0.05, 0.1);
  const BodyModel model(prism, lively());
  Stepper used(model), fresh(model);
  used.start(kernelState(sampleInitialState(prism, 3, 1), 0));
  for (int i = 0; i < 500; ++i) used.advance(Stepper::kNoLimit);
  const KernelState<double> start = kernelState(sampleInitialState(prism, 3, 2), 0);
  used.start(start);
  fresh.start(start);
  for (int i = 0; i < 2000; ++i) {
    used.advance(Stepper::kNoLimit);
    fresh.advance(Stepper::kNoLimit);
    ASSERT_EQ(hashState(used.state(), 1), hashState(fresh.state(), 1)) << i;
  }
}

/// A deliberate change of the kernel's motions changes this; whoever makes one puts the new value
/// here and raises kSimulationVersion.
TEST(KernelBits, AreTheGoldenOnes) {
  const Body box = makeBoxBody({0.0625, 0.03125, 0.015625}, 0.03125);
  const Body cube = makeBoxBody({0.015625, 0.015625, 0.015625}, 0.00390625);
  std::uint64_t hash = 0;
  for (const Body* body : {&box, &cube}) {
    const BodyModel model(*body, lively());
    for (int i = 0; i < 8; ++i) hash = hash * 31 + hashOfDrop(model, exactStart(i));
  }
  EXPECT_EQ(hash, 5018589165180115280ULL);
}

}  // namespace
}  // namespace ifa
