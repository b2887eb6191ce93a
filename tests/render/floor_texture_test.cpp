// SPDX-License-Identifier: Apache-2.0
#include "render/floor_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "scenes.h"

namespace ifa::render {
namespace {

constexpr float kTile = 0.512f;
constexpr float kTexel = kTile / 2048;
const Eigen::Vector2f kRound(0, 0);

const FloorTexture& texture(const std::string& surface) {
  static std::map<std::string, FloorTexture> all;
  return all.try_emplace(surface, surface).first->second;
}

class Floor : public testing::TestWithParam<const char*> {};

TEST_P(Floor, RepeatsWithItsTile) {
  const FloorTexture& floor = texture(GetParam());
  test::Lottery lottery;
  double error = 0;
  for (int i = 0; i < 500; ++i) {
    const auto x = static_cast<float>(lottery.between(0, kTile));
    const auto y = static_cast<float>(lottery.between(0, kTile));
    const auto columns = static_cast<float>(static_cast<int>(lottery.between(-4, 5)));
    const auto rows = static_cast<float>(static_cast<int>(lottery.between(-4, 5)));
    const Colour here = floor.at(x, y, 4 * kTexel, kRound);
    const Colour there = floor.at(x + columns * kTile, y + rows * kTile, 4 * kTexel, kRound);
    error = std::max(error, static_cast<double>((here - there).abs().maxCoeff()));
  }
  EXPECT_LT(error, 2e-3);
}

// Columns on both sides of the seam are as much alike as columns elsewhere, there too between two
// of the carpet's 192 rows of loops.
TEST_P(Floor, HasNoSeams) {
  const FloorTexture& floor = texture(GetParam());
  const auto step = [&](float x, float y, bool across) {
    const float dx = across ? kTexel : 0, dy = across ? 0 : kTexel;
    return (floor.at(x, y, kTexel, kRound) - floor.at(x - dx, y - dy, kTexel, kRound)).abs().mean();
  };
  for (const bool across : {true, false}) {
    float seam = 0, elsewhere = 0;
    for (int i = 0; i < 400; ++i) {
      const float along = kTile * (static_cast<float>(i) + 0.37f) / 400;
      const float away = kTile * static_cast<float>(9 * (i % 7) + 5) / 64 + 0.5f * kTexel;
      const float edge = 0.5f * kTexel;
      seam += across ? step(edge, along, true) : step(along, edge, false);
      elsewhere += across ? step(away, along, true) : step(along, away, false);
    }
    EXPECT_LT(seam, 2.5f * elsewhere + 0.2f) << (across ? "left and right" : "top and bottom");
  }
}

TEST_P(Floor, FarAwayOnlyItsMeanIsSeen) {
  const FloorTexture& floor = texture(GetParam());
  Colour sum = Colour::Zero();
  constexpr int kSide = 128;
  for (int i = 0; i < kSide * kSide; ++i) {
    sum += floor.at(kTile * (static_cast<float>(i % kSide) + 0.5f) / kSide,
                    kTile * (static_cast<float>(i / kSide) + 0.5f) / kSide, kTile / kSide, kRound);
  }
  const Colour average = sum / (kSide * kSide);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(average[k], floor.mean()[k], 0.04f * floor.mean()[k]);
  for (const float x : {0.0f, 0.3f, -7.1f}) {
    EXPECT_LT((floor.at(x, 0.2f, 2, kRound) - floor.mean()).abs().maxCoeff(), 1e-5f);
  }
}

// The variance over places falls as footprints grow, in one direction alone too.
TEST_P(Floor, DetailFadesWithTheFootprint) {
  const FloorTexture& floor = texture(GetParam());
  const auto variance = [&](float across, const Eigen::Vector2f& along) {
    test::Lottery lottery;
    double sum = 0, squares = 0;
    for (int i = 0; i < 600; ++i) {
      const double value = static_cast<double>(
          floor.at(static_cast<float>(lottery()), static_cast<float>(lottery()), across, along)
              .mean());
      sum += value, squares += value * value;
    }
    return squares / 600 - sum * sum / 360000;
  };
  const double fine = variance(kTexel, kRound), coarse = variance(32 * kTexel, kRound);
  EXPECT_GT(fine, 1e-5) << "there is something to be seen";
  EXPECT_LT(coarse, fine);
  EXPECT_LT(variance(4 * kTexel, {0, 24 * kTexel}), variance(4 * kTexel, kRound));
}

TEST_P(Floor, IsTheSameInEveryRunAndReflectsLessThanItGets) {
  const FloorTexture& floor = texture(GetParam());
  const FloorTexture again(GetParam());
  test::Lottery lottery;
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(lottery()), y = static_cast<float>(lottery());
    const Colour colour = floor.at(x, y, kTexel, kRound);
    ASSERT_TRUE((colour == again.at(x, y, kTexel, kRound)).all());
    ASSERT_GE(colour.minCoeff(), 0);
    ASSERT_LT(colour.maxCoeff(), 0.8f);
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Floor, testing::Values("desk", "wood", "carpet"));

TEST(FloorTexture, SurfacesDiffer) {
  const Colour desk = texture("desk").mean(), wood = texture("wood").mean(),
               carpet = texture("carpet").mean();
  EXPECT_GT((desk - wood).abs().maxCoeff(), 0.03f);
  EXPECT_GT((desk - carpet).abs().maxCoeff(), 0.03f);
  EXPECT_GT((wood - carpet).abs().maxCoeff(), 0.03f);
  EXPECT_GT(desk.x(), desk.z()) << "wood is warm";
  EXPECT_GT(texture("desk").gloss(), 0);
  EXPECT_GT(texture("wood").gloss(), 0);
  EXPECT_EQ(texture("carpet").gloss(), 0);
}

TEST(FloorTexture, AnythingElseLooksLikeADesk) {
  EXPECT_TRUE((texture("marble").mean() == texture("desk").mean()).all());
  EXPECT_TRUE((texture("marble").at(0.1f, 0.2f, kTexel, kRound) ==
               texture("desk").at(0.1f, 0.2f, kTexel, kRound))
                  .all());
}

}  // namespace
}  // namespace ifa::render
