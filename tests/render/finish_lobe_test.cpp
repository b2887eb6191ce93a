// SPDX-License-Identifier: Apache-2.0
#include "render/finish_lobe.h"

#include <gtest/gtest.h>

#include <tuple>

#include "scenes.h"

namespace ifa::render {
namespace {

Finish finish(float alpha, float metallic, const Colour& colour = Colour::Ones()) {
  Finish f;
  f.colour = colour;
  f.alpha = alpha;
  f.metallic = metallic;
  return f;
}

/// A direction at this angle from a normal that lies askew in the world.
const Vector kNormal = Vector(0.3f, -0.5f, 0.8f).normalized();
Vector viewAt(float angle) {
  const Frame frame(kNormal);
  return frame.toWorld(0.6f * std::sin(angle), 0.8f * std::sin(angle), std::cos(angle));
}

/// A direction by the lobe, for u and v in [0, 1).
Vector draw(const FinishLobe& lobe, float u, float v, Colour& weight) {
  const float radius = std::sqrt(u), angle = 2 * kPi * v;
  return lobe.sample(radius * std::cos(angle), radius * std::sin(angle), weight);
}

/// Mean weight of evenly spread samples.
Colour meanWeight(const FinishLobe& lobe, int side) {
  Colour sum = Colour::Zero(), weight;
  for (int i = 0; i < side * side; ++i) {
    const auto n = static_cast<float>(side);
    (void)draw(lobe, (static_cast<float>(i % side) + 0.5f) / n,
               (static_cast<float>(i / side) + 0.5f) / n, weight);
    sum += weight;
  }
  return sum / static_cast<float>(side * side);
}

/// Sum of `value(direction, cosine)` over the hemisphere about kNormal, finest about the normal.
template <class Value>
double overLobe(const Value& value) {
  constexpr int kRows = 160, kColumns = 480;
  const Frame frame(kNormal);
  double sum = 0;
  for (int row = 0; row < kRows; ++row) {
    const float share = (static_cast<float>(row) + 0.5f) / kRows;
    const float z = 1 - share * share, r = std::sqrt(1 - z * z);
    float line = 0;
    for (int column = 0; column < kColumns; ++column) {
      const float angle = 2 * kPi * (static_cast<float>(column) + 0.5f) / kColumns;
      line += value(frame.toWorld(r * std::cos(angle), r * std::sin(angle), z), z);
    }
    sum += static_cast<double>(line * 2 * share * 2 * kPi / (kRows * kColumns));
  }
  return sum;
}

class Lobe : public testing::TestWithParam<std::tuple<float, float>> {
 protected:
  float alpha() const { return std::get<0>(GetParam()); }
  Vector view() const { return viewAt(std::get<1>(GetParam())); }
};

// Wide enough for a sum over directions.
class WideLobe : public Lobe {};

TEST_P(Lobe, SendsNoMoreLightThanArrives) {
  for (const float metallic : {0.0f, 0.5f, 1.0f}) {
    const Finish white = finish(alpha(), metallic);
    const FinishLobe lobe(white, kNormal, view());
    Colour weight;
    test::Lottery lottery;
    for (int i = 0; i < 500; ++i) {
      (void)draw(lobe, lottery.single(), lottery.single(), weight);
      ASSERT_GE(weight.minCoeff(), 0);
      ASSERT_LE(weight.maxCoeff(), 1 + 1e-5f);
    }
  }
  // A polished white metal in a white room is white.
  if (alpha() <= 0.1f && std::get<1>(GetParam()) < 1.2f) {
    const Finish white = finish(alpha(), 1);
    EXPECT_GT(meanWeight(FinishLobe(white, kNormal, view()), 64).minCoeff(), 0.97f);
  }
}

TEST_P(WideLobe, DensityIsThatOfItsSamples) {
  const Finish white = finish(alpha(), 1);
  const FinishLobe lobe(white, kNormal, view());
  const double above = overLobe([&](const Vector& d, float) { return lobe.density(d); });
  // What lies below the surface is drawn too, with a weight of zero.
  int drawn = 0;
  constexpr int kSide = 200;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), expected = Eigen::Vector3d::Zero();
  for (int i = 0; i < kSide * kSide; ++i) {
    Colour weight;
    const Vector d = draw(lobe, (static_cast<float>(i % kSide) + 0.5f) / kSide,
                          (static_cast<float>(i / kSide) + 0.5f) / kSide, weight);
    if (d.dot(kNormal) <= 0) continue;
    ++drawn;
    mean += d.cast<double>();
  }
  EXPECT_NEAR(above, static_cast<double>(drawn) / (kSide * kSide), 0.02);
  mean /= kSide * kSide;
  for (int axis = 0; axis < 3; ++axis) {
    expected[axis] = overLobe([&](const Vector& d, float) { return lobe.density(d) * d[axis]; });
  }
  EXPECT_LT((mean - expected).norm(), 0.02);
}

TEST_P(WideLobe, SamplesAmountToTheReflectance) {
  for (const float metallic : {0.0f, 1.0f}) {
    const Finish coloured = finish(alpha(), metallic, {0.9f, 0.5f, 0.2f});
    const FinishLobe lobe(coloured, kNormal, view());
    const Colour sampled = meanWeight(lobe, 128);
    for (int k = 0; k < 3; ++k) {
      const double summed =
          overLobe([&](const Vector& d, float cosine) { return lobe.reflectance(d)[k] * cosine; });
      EXPECT_NEAR(static_cast<double>(sampled[k]), summed, 0.02 * summed + 2e-4);
    }
  }
}

const auto kViews = testing::Values(0.0f, 0.5f, 1.0f, 1.35f);
INSTANTIATE_TEST_SUITE_P(Finishes, Lobe,
                         testing::Combine(testing::Values(0.005f, 0.05f, 0.2f, 1.0f), kViews));
INSTANTIATE_TEST_SUITE_P(Finishes, WideLobe,
                         testing::Combine(testing::Values(0.05f, 0.2f, 0.5f, 1.0f), kViews));

TEST(FinishLobe, MirrorsWhereAMirrorWould) {
  const Finish polished = finish(0.004f, 1, {0.9f, 0.6f, 0.3f});
  const Vector view = viewAt(0.7f);
  const FinishLobe lobe(polished, kNormal, view);
  Colour weight;
  for (const float u : {0.0f, 0.3f, 0.6f}) {
    const Vector d = draw(lobe, u, 0.4f, weight);
    EXPECT_GT(d.dot(reflected(view, kNormal)), 0.999f);
    EXPECT_NEAR(weight.x() / weight.z(), 3, 0.2);
  }
}

TEST(FinishLobe, PlasticReflectsLittleHeadOnAndMuchAtAGlance) {
  const Finish plastic = finish(0.1f, 0, {0.8f, 0.1f, 0.1f});
  const Colour headOn = meanWeight(FinishLobe(plastic, kNormal, viewAt(0)), 32);
  const Colour glance = meanWeight(FinishLobe(plastic, kNormal, viewAt(1.5f)), 32);
  EXPECT_NEAR(headOn.x(), 0.04, 0.005);
  EXPECT_NEAR(headOn.x(), headOn.y(), 1e-5) << "the colour lies below the varnish";
  EXPECT_GT(glance.minCoeff(), 0.25f);
}

TEST(FinishLobe, NothingIsReflectedThroughTheSurface) {
  const Finish white = finish(0.3f, 1);
  const FinishLobe lobe(white, kNormal, viewAt(0.4f));
  EXPECT_EQ(lobe.density(-kNormal), 0);
  EXPECT_TRUE((lobe.reflectance(-kNormal) == 0).all());
}

}  // namespace
}  // namespace ifa::render
