// SPDX-License-Identifier: Apache-2.0
#include "render/studio.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.h"

namespace ifa::render {
namespace {

const Colour kAlbedo(0.3f, 0.2f, 0.1f);

Studio studio(float azimuth = 0.7f) { return {azimuth, kAlbedo}; }

void expectNear(const Colour& found, const Colour& expected, float relative) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], relative * expected.maxCoeff());
}

/// Irradiance of a surface with this normal by sky and unshadowed floor, summed over directions.
Colour irradiance(const Studio& light, const Vector& normal) {
  Colour sum = Colour::Zero();
  test::overHemisphere(64, [&](const Vector& up, float solid) {
    for (const Vector& d : {up, Vector(-up)}) {
      const Colour radiance = d.z() > 0 ? light.sky(d) : light.floorRadiance();
      sum += radiance * std::max(0.0f, normal.dot(d)) * solid;
    }
  });
  return sum;
}

TEST(Studio, KnowsTheSkysLightForEveryNormal) {
  const Studio light = studio();
  test::Lottery lottery;
  for (int i = 0; i < 40; ++i) {
    const Vector normal = lottery.direction();
    expectNear(light.ambient(normal), irradiance(light, normal), 0.05f);
  }
}

TEST(Studio, KnowsTheLightOfTheFloor) {
  const Studio light = studio();
  Colour sky = Colour::Zero(), key = Colour::Zero();
  test::overHemisphere(256, [&](const Vector& d, float solid) {
    sky += light.sky(d) * d.z() * solid;
    key += light.key(d) * d.z() * solid;
  });
  expectNear(light.skyOnFloor(), sky, 0.01f);
  expectNear(light.keyOnFloor(), key, 0.02f);
  expectNear(light.floorRadiance(), kAlbedo / kPi * (sky + key), 0.02f);
  // White paper on the floor shows about 1.
  const float white = (light.skyOnFloor() + light.keyOnFloor()).mean() / kPi;
  EXPECT_GT(white, 0.7f);
  EXPECT_LT(white, 1.4f);
}

TEST(Studio, KeyLightIsASquareAboutItsMiddle) {
  const Studio light = studio();
  test::Lottery lottery;
  float widest = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector d = light.towardsKey(lottery.single(), lottery.single());
    ASSERT_NEAR(d.norm(), 1, 1e-5);
    ASSERT_GT(light.keyDensity(d), 0) << i;
    ASSERT_GT(light.key(d).minCoeff(), 0) << i;
    widest = std::max(widest, std::acos(std::min(1.0f, d.dot(light.keyDirection()))));
  }
  EXPECT_LE(widest, light.keyAngle() + 1e-4f);
  EXPECT_GT(widest, 0.9f * light.keyAngle());
  EXPECT_GT(light.towardsKey(0.5f, 0.5f).dot(light.keyDirection()), 0.99999f);
  EXPECT_EQ(light.keyDensity(-light.keyDirection()), 0);
  EXPECT_TRUE((light.key(-light.keyDirection()) == 0).all());
  EXPECT_EQ(light.keyDensity(Vector::UnitX()), 0);
}

TEST(Studio, DensityOfKeyDirectionsIsThatOfItsSamples) {
  const Studio light = studio();
  double whole = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), expected = Eigen::Vector3d::Zero();
  test::overHemisphere(800, [&](const Vector& d, float solid) {
    const auto share = static_cast<double>(light.keyDensity(d) * solid);
    whole += share;
    moment += share * d.cast<double>();
  });
  for (int i = 0; i < 400; ++i) {
    const auto d = light.towardsKey((static_cast<float>(i % 20) + 0.5f) / 20,
                                    (static_cast<float>(i / 20) + 0.5f) / 20);
    expected += d.cast<double>() / 400;
  }
  EXPECT_NEAR(whole, 1, 0.01);
  EXPECT_LT((moment / whole - expected).norm(), 2e-3);
}

TEST(Studio, TurnsWithTheCamera) {
  const Studio first = studio(0.7f), second = studio(2.1f);
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(1.4f, Vector::UnitZ()).toRotationMatrix();
  EXPECT_LT((turn * first.keyDirection() - second.keyDirection()).norm(), 1e-5f);
  test::Lottery lottery;
  for (int i = 0; i < 20; ++i) {
    const Vector d = lottery.direction();
    expectNear(second.sky(turn * d), first.sky(d), 1e-3f);
    expectNear(second.ambient(turn * d), first.ambient(d), 1e-2f);
  }
  // The key light stands on the camera's left, above.
  const Vector right(std::sin(0.7f), -std::cos(0.7f), 0);
  EXPECT_LT(first.keyDirection().dot(right), -0.2f);
  EXPECT_GT(first.keyDirection().z(), 0.5f);
}

TEST(Studio, KeyLightFallsByTheCosine) {
  const Studio light = studio();
  expectNear(light.keyIrradiance(Vector::UnitZ()), light.keyOnFloor(), 1e-5f);
  const Colour facing = light.keyIrradiance(light.keyDirection());
  expectNear(facing * light.keyDirection().z(), light.keyOnFloor(), 1e-4f);
  EXPECT_TRUE((light.keyIrradiance(-Vector::UnitZ()) == 0).all());
}

}  // namespace
}  // namespace ifa::render
