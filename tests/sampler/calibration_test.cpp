// SPDX-License-Identifier: Apache-2.0
#include "sampler/calibration.h"

#include <gtest/gtest.h>

#include "support/box_body.h"

namespace ifa {
namespace {

CalibrationSettings quick() {
  CalibrationSettings settings;
  settings.simulations = 300;
  settings.tolerance = 0.03;
  return settings;
}

TEST(Calibration, FindsTheRestitutionOfAKnownSurface) {
  const Body die = makeDieBody();
  SurfaceProperties surface;
  surface.restitution = 0.7;
  const SurfaceMeasurement known = measureSurface(die, surface, quick());
  EXPECT_EQ(known.unfinished, 0U);
  // A die hits with at most about (1 + e) m v, v up to 4 m/s.
  EXPECT_GT(known.referenceImpulse, die.mass * 0.5);
  EXPECT_LT(known.referenceImpulse, die.mass * 1.7 * 4.5);
  const Calibration found =
      calibrateSurface(die, SurfaceProperties{}, known.eventsPerSimulation, quick());
  EXPECT_TRUE(found.reached);
  EXPECT_NEAR(found.surface.restitution, 0.7, 0.03);
  EXPECT_DOUBLE_EQ(found.surface.friction, SurfaceProperties{}.friction);
  EXPECT_DOUBLE_EQ(found.surface.referenceImpulse, found.measured.referenceImpulse);
}

TEST(Calibration, SaysWhenTheTargetIsOutOfReach) {
  const Calibration found = calibrateSurface(makeDieBody(), SurfaceProperties{}, 500, quick());
  EXPECT_FALSE(found.reached);
  EXPECT_DOUBLE_EQ(found.surface.restitution, quick().highestRestitution);
}

}  // namespace
}  // namespace ifa
