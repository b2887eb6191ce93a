// SPDX-License-Identifier: Apache-2.0
#include "render/tone.h"

#include <gtest/gtest.h>

namespace ifa::render {
namespace {

TEST(Tone, IsMonotoneAndNeverWhite) {
  float last = -1;
  for (float x = 0; x < 4; x += 0.01f) {
    const float value = toned(Colour::Constant(x)).x();
    EXPECT_GT(value, last) << x;
    EXPECT_LT(value, 1) << x;
    last = value;
  }
  EXPECT_LE(toned(Colour::Constant(1e6f)).maxCoeff(), 1);
}

TEST(Tone, LeavesDarkerHalfAloneAndBendsSmoothly) {
  for (const float x : {0.0f, 0.1f, 0.3f, 0.5f}) {
    EXPECT_FLOAT_EQ(toned(Colour::Constant(x)).y(), x);
  }
  const auto slope = [](float x) {
    return (toned(Colour::Constant(x + 1e-3f)) - toned(Colour::Constant(x))).x() / 1e-3f;
  };
  EXPECT_NEAR(slope(0.501f), 1, 0.01);
  for (float x = 0.5f; x < 3; x += 0.1f) EXPECT_LT(slope(x + 0.1f), slope(x));
}

TEST(Tone, TreatsColoursOneByOne) {
  const Colour found = toned({0.2f, 0.9f, -0.5f});
  EXPECT_FLOAT_EQ(found.x(), 0.2f);
  EXPECT_FLOAT_EQ(found.y(), toned(Colour::Constant(0.9f)).x());
  EXPECT_EQ(found.z(), 0);
}

TEST(ScreenCurve, IsThatOfSrgb) {
  const ScreenCurve curve;
  for (int i = 0; i <= 100000; ++i) {
    const double x = i / 100000.0;
    const double exact = 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
    ASSERT_NEAR(curve(static_cast<float>(x)), exact, 0.76) << x;
  }
}

TEST(ScreenCurve, IsMonotoneAndTakesWhatIsOutside) {
  const ScreenCurve curve;
  EXPECT_EQ(curve(-1), 0);
  EXPECT_EQ(curve(0), 0);
  EXPECT_EQ(curve(1), 255);
  EXPECT_EQ(curve(7), 255);
  EXPECT_EQ(curve(std::nanf("")), 0);
  for (int i = 0; i < 5000; ++i) {
    ASSERT_LE(curve(static_cast<float>(i) / 5000), curve(static_cast<float>(i + 1) / 5000));
  }
}

}  // namespace
}  // namespace ifa::render
