// SPDX-License-Identifier: Apache-2.0
#include "render/sample_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace ifa::render {
namespace {

/// Two numbers of a sample that belong together, each even in [0, 1).
struct Pair {
  float Sample::*first, Sample::*second;
  bool inDisc = false;

  [[nodiscard]] std::array<float, 2> of(const Sample& s) const {
    const float a = s.*first, b = s.*second;
    if (!inDisc) return {a, b};
    // Rings of equal area, and the angle; a trifle for rounding.
    const float angle = std::atan2(b, a) / 6.2831853f;
    return {(a * a + b * b) * (1 - 3e-7f), angle < 0 ? angle + 1 : angle};
  }
};

const std::vector<Pair> kPairs = {{&Sample::x, &Sample::y},
                                  {&Sample::key0, &Sample::key1},
                                  {&Sample::diffuseX, &Sample::diffuseY, true},
                                  {&Sample::specularX, &Sample::specularY, true}};

int stratum(float value, int strata) {
  return static_cast<int>(value * static_cast<float>(strata));
}

class SampleTables : public testing::TestWithParam<int> {};

TEST_P(SampleTables, StayInTheirRanges) {
  const SampleTable table(GetParam());
  EXPECT_EQ(table.perPixel(), GetParam());
  const Sample* all = table.at(0, 0);
  for (int y = 0; y < SampleTable::kTile; ++y) {
    for (int x = 0; x < SampleTable::kTile; ++x) {
      all = table.at(x, y);
      for (int i = 0; i < GetParam(); ++i) {
        for (const Pair& pair : kPairs) {
          const auto [a, b] = pair.of(all[i]);
          ASSERT_GE(std::min(a, b), 0.0f);
          ASSERT_LT(std::max(a, b), 1.0f);
        }
        ASSERT_GE(all[i].choice, 0.0f);
        ASSERT_LT(all[i].choice, 1.0f);
        ASSERT_LT(all[i].instant, kInstants);
      }
    }
  }
}

// Each of n strata of every number holds one of a pixel's n samples.
TEST_P(SampleTables, SpreadOverEveryPixel) {
  const int count = GetParam();
  const SampleTable table(count);
  for (int y = 0; y < SampleTable::kTile; ++y) {
    for (int x = 0; x < SampleTable::kTile; ++x) {
      const Sample* samples = table.at(x, y);
      for (const Pair& pair : kPairs) {
        std::set<int> first, second;
        for (int i = 0; i < count; ++i) {
          first.insert(stratum(pair.of(samples[i])[0], count));
          second.insert(stratum(pair.of(samples[i])[1], count));
        }
        ASSERT_EQ(first.size(), static_cast<std::size_t>(count)) << x << ", " << y;
        ASSERT_EQ(second.size(), static_cast<std::size_t>(count)) << x << ", " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, SampleTables, testing::Values(1, 2, 4, 8, 16, 64));

TEST(SampleTable, SpreadsAPixelsSamplesInBothDirectionsAtOnce) {
  const SampleTable table(16);
  for (int pixel = 0; pixel < 64; ++pixel) {
    const Sample* samples = table.at(pixel % 8, pixel / 8);
    for (const Pair& pair : kPairs) {
      // One in each of the 4 by 4, 2 by 8 and 8 by 2 cells.
      for (const int across : {2, 4, 8}) {
        std::set<int> cells;
        for (int i = 0; i < 16; ++i) {
          const auto [a, b] = pair.of(samples[i]);
          cells.insert(stratum(a, across) * 16 + stratum(b, 16 / across));
        }
        ASSERT_EQ(cells.size(), 16u) << "pixel " << pixel << ", " << across << " across";
      }
    }
  }
}

TEST(SampleTable, SpreadsATileAsAWhole) {
  const SampleTable table(4);
  for (const Pair& pair : kPairs) {
    std::set<int> first, cells;
    for (int pixel = 0; pixel < 64; ++pixel) {
      for (int i = 0; i < 4; ++i) {
        const auto [a, b] = pair.of(table.at(pixel % 8, pixel / 8)[i]);
        first.insert(stratum(a, 256));
        cells.insert(stratum(a, 16) * 16 + stratum(b, 16));
      }
    }
    EXPECT_EQ(first.size(), 256u);
    EXPECT_EQ(cells.size(), 256u);
  }
}

TEST(SampleTable, HasEveryInstantEquallyOften) {
  const SampleTable table(16);
  std::vector<int> of(kInstants);
  for (int pixel = 0; pixel < 64; ++pixel) {
    std::set<int> quarters;
    for (int i = 0; i < 16; ++i) {
      const int instant = table.at(pixel % 8, pixel / 8)[i].instant;
      ++of[static_cast<std::size_t>(instant)];
      quarters.insert(instant / 4);
    }
    EXPECT_EQ(quarters.size(), 16u) << "each sixteenth of the opening is seen once";
  }
  EXPECT_EQ(*std::min_element(of.begin(), of.end()), 16);
  EXPECT_EQ(*std::max_element(of.begin(), of.end()), 16);
}

TEST(SampleTable, RepeatsTileByTileAndInEveryRun) {
  const SampleTable table(8), again(8);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(table.at(3, 5)[i].x, table.at(3 + 8 * 7, 5 + 8 * 20)[i].x);
    EXPECT_EQ(table.at(3, 5)[i].specularY, again.at(3, 5)[i].specularY);
  }
  EXPECT_NE(table.at(0, 0)[0].x, table.at(1, 0)[0].x);
  EXPECT_EQ(table.all().size(), 64u * 8);
  EXPECT_EQ(&table.all()[table.indexAt(13, 6)], table.at(5, 6));
}

}  // namespace
}  // namespace ifa::render
