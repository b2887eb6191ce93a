// SPDX-License-Identifier: Apache-2.0
#include "sonify/block_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/box_body.h"

namespace ifa {
namespace {

Block steelBar() {
  Block bar;
  bar.sides = {0.2, 0.012, 0.005};
  bar.young = 205e9;
  bar.poisson = 0.29;
  bar.density = 7850;
  return bar;
}

TEST(BlockModes, AThinBarBendsAsEulerAndBernoulliSay) {
  const Block bar = steelBar();
  const auto modes = blockModes(bar, 15000);
  ASSERT_GE(modes.size(), 4U);
  const double waves = std::sqrt(bar.young / bar.density);
  const auto bending = [&](double root, double thickness) {
    return root * root / (2 * std::numbers::pi * bar.sides.x() * bar.sides.x()) * waves *
           thickness / std::sqrt(12.0);
  };
  EXPECT_NEAR(modes[0].frequency() / bending(4.7300, 0.005), 1, 0.01);
  EXPECT_NEAR(modes[1].frequency() / bending(4.7300, 0.012), 1, 0.02);
  EXPECT_NEAR(modes[2].frequency() / bending(7.8532, 0.005), 1, 0.03);
  const double along = waves / (2 * bar.sides.x());
  EXPECT_TRUE(std::any_of(modes.begin(), modes.end(), [&](const BlockMode& mode) {
    return std::abs(mode.frequency() / along - 1) < 0.005;
  }));
}

TEST(BlockModes, ShapesAreNormalisedToTheMass) {
  Block cube;
  cube.sides = Eigen::Vector3d::Constant(0.1);
  cube.young = 3.2e9;
  cube.poisson = 0.37;
  cube.density = 1180;
  const auto modes = blockModes(cube, 12000);
  ASSERT_GE(modes.size(), 3U);
  constexpr int kGrid = 32;
  for (const BlockMode& mode : modes) {
    double sum = 0;
    for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
      const Eigen::Vector3d cell(i % kGrid, i / kGrid % kGrid, i / (kGrid * kGrid));
      const Eigen::Vector3d unit = (cell.array() + 0.5).matrix() / kGrid;
      sum += mode.shapeAt(0.1 * (unit.array() - 0.5).matrix()).squaredNorm();
    }
    EXPECT_NEAR(sum / (kGrid * kGrid * kGrid) * 1180 * 1e-3, 1, 0.02);
    EXPECT_GT(mode.surfaceMotion(), 0);
  }
}

TEST(BlockModes, AFullBoxIsItsOwnBlockAndAHollowOneIsSofter) {
  const auto acrylic = findSoundMaterial("acrylic");
  ASSERT_TRUE(acrylic);
  const Eigen::Vector3d sides(0.03, 0.02, 0.01);
  const double full = sides.prod() * acrylic->density;
  const Block block = blockLike(makeBoxBody(sides, full), *acrylic);
  EXPECT_LT((block.sides - sides).norm(), 1e-9);
  EXPECT_NEAR(block.young / acrylic->young, 1, 1e-6);
  const Block hollow = blockLike(makeBoxBody(sides, full / 2), *acrylic);
  const double ratio =
      blockModes(hollow, 1e6).front().frequency() / blockModes(block, 1e6).front().frequency();
  EXPECT_NEAR(ratio, 0.5, 1e-6);
}

}  // namespace
}  // namespace ifa
