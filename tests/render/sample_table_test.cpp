// SPDX-License-Identifier: Apache-2.0
#include "render/sample_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace ifa::render {
namespace {

using Field = float Sample::*;

const std::vector<std::pair<Field, Field>> kPairs = {{&Sample::x, &Sample::y},
                                                     {&Sample::key0, &Sample::key1},
                                                     {&Sample::diffuse0, &Sample::diffuse1},
                                                     {&Sample::specular0, &Sample::specular1}};

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
        for (const auto& [a, b] : kPairs) {
          ASSERT_GE(std::min(all[i].*a, all[i].*b), 0.0f);
          ASSERT_LT(std::max(all[i].*a, all[i].*b), 1.0f);
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
      for (const auto& [a, b] : kPairs) {
        std::set<int> first, second;
        for (int i = 0; i < count; ++i) {
          first.insert(stratum(samples[i].*a, count));
          second.insert(stratum(samples[i].*b, count));
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
    for (const auto& [a, b] : kPairs) {
      // One in each of the 4 by 4, 2 by 8 and 8 by 2 cells.
      for (const int across : {2, 4, 8}) {
        std::set<int> cells;
        for (int i = 0; i < 16; ++i) {
          cells.insert(stratum(samples[i].*a, across) * 16 + stratum(samples[i].*b, 16 / across));
        }
        ASSERT_EQ(cells.size(), 16u) << "pixel " << pixel << ", " << across << " across";
      }
    }
  }
}

TEST(SampleTable, SpreadsATileAsAWhole) {
  const SampleTable table(4);
  for (const auto& [a, b] : kPairs) {
    std::set<int> first, cells;
    for (int pixel = 0; pixel < 64; ++pixel) {
      for (int i = 0; i < 4; ++i) {
        const Sample& s = table.at(pixel % 8, pixel / 8)[i];
        first.insert(stratum(s.*a, 256));
        cells.insert(stratum(s.*a, 16) * 16 + stratum(s.*b, 16));
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
    EXPECT_EQ(table.at(3, 5)[i].specular1, again.at(3, 5)[i].specular1);
  }
  EXPECT_NE(table.at(0, 0)[0].x, table.at(1, 0)[0].x);
}

}  // namespace
}  // namespace ifa::render
