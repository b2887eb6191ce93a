// SPDX-License-Identifier: Apache-2.0
// Our kernel against ODE over thousands of drops, at a restitution where ODE keeps its energy.
#include <gtest/gtest.h>

#include <string>

#include "body/object_file.h"
#include "sampler/simulator_comparison.h"

namespace ifa {
namespace {

class OdeComparison : public testing::TestWithParam<std::string> {};

TEST_P(OdeComparison, DropsHaveTheSameStatistics) {
  const auto body = loadObject(GetParam());
  ASSERT_TRUE(body) << body.error().text();
  SurfaceProperties surface = body->definition.surfaces.at(body->definition.defaultSurface);
  surface.restitution = 0.5;
  const SimulatorComparison c = compareWithOde(*body, surface, {});
  EXPECT_LE(c.eventCounts, 0.15);
  EXPECT_LE(c.restTimes, 0.10);
  EXPECT_LE(c.gaps, 0.10);
  EXPECT_EQ(c.native.unfinished, 0U);
  EXPECT_EQ(c.ode.unfinished, 0U);
}

INSTANTIATE_TEST_SUITE_P(Objects, OdeComparison,
                         testing::Values("d4", "d6", "d8", "d10", "d12", "d20", "Eraser",
                                         "CoffeeCup", "Nut", "Lego2x2"));

}  // namespace
}  // namespace ifa
