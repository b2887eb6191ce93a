// SPDX-License-Identifier: Apache-2.0
// Thousands of drops of every object: no energy from nowhere, nothing under the ground, everything
// comes to rest.
#include "kernel_drops.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/parallel.h"
#include "body/object_file.h"
#include "sampler/initial_state.h"

namespace ifa {
namespace {

constexpr std::size_t kDrops = 10000;
constexpr double kTimeLimit = 120;  // s
/// Rounding, and what an angular velocity from a series leaves in a long flight.
constexpr double kEnergyRounding = 1e-9;

class KernelDrops : public testing::TestWithParam<std::string> {};

TEST_P(KernelDrops, NeverGainEnergySinkOrRollForEver) {
  const auto body = loadObject(GetParam());
  ASSERT_TRUE(body) << body.error().text();
  const BodyModel model(*body, body->definition.surfaces.at(body->definition.defaultSurface));
  std::vector<DropCheck> checks(kDrops);
  parallelFor(kDrops, [&](std::size_t i) {
    const double restitution = 0.95 - 0.05 * static_cast<double>(i % 10);
    checks[i] = checkDrop(model, sampleInitialState(*body, 9, i), kTimeLimit, restitution);
  });
  const double depth = std::max(1e-4, 1e-3 * body->size);
  for (std::size_t i = 0; i < kDrops; ++i) {
    EXPECT_LE(checks[i].gain, kEnergyRounding) << i;
    EXPECT_LE(checks[i].depth, depth) << i;
    EXPECT_TRUE(checks[i].rested) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Objects, KernelDrops,
                         testing::Values("d4", "d6", "d8", "d10", "d12", "d20", "Eraser",
                                         "CoffeeCup", "Nut", "Lego2x2"));

}  // namespace
}  // namespace ifa
