// SPDX-License-Identifier: Apache-2.0
#include "render/contact_sheet.h"

#include <gtest/gtest.h>

#include "scenes.h"
#include "support/pixels.h"

namespace ifa::render {
namespace {

constexpr int kWidth = 48, kHeight = 32;

std::vector<SheetEntry> entries(int count) {
  std::vector<SheetEntry> all;
  test::Lottery lottery;
  for (int i = 0; i < count; ++i) {
    SheetEntry entry{Image(kWidth, kHeight), std::to_string(i + 1)};
    for (auto& value : entry.picture.rgb)
      value = static_cast<std::uint8_t>(lottery.between(0, 256));
    all.push_back(std::move(entry));
  }
  return all;
}

bool holds(const Image& sheet, const Image& picture, int left, int top) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (test::pixelAt(sheet, left + x, top + y) != test::pixelAt(picture, x, y)) return false;
    }
  }
  return true;
}

/// Upper left corners of a picture in the sheet.
std::vector<std::pair<int, int>> placesOf(const Image& sheet, const Image& picture) {
  std::vector<std::pair<int, int>> places;
  for (int top = 0; top + picture.height <= sheet.height; ++top) {
    for (int left = 0; left + picture.width <= sheet.width; ++left) {
      if (test::pixelAt(sheet, left, top) != test::pixelAt(picture, 0, 0)) continue;
      if (holds(sheet, picture, left, top)) places.emplace_back(left, top);
    }
  }
  return places;
}

class Sheet : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Sheet, HoldsEveryPictureOnceInReadingOrder) {
  const auto [count, columns] = GetParam();
  EXPECT_EQ(sheetColumns(count), columns);
  const auto all = entries(count);
  const Image sheet = contactSheet(all, "title");
  const int rows = (count + columns - 1) / columns;
  EXPECT_GT(sheet.width, columns * kWidth);
  EXPECT_LT(sheet.width, columns * (kWidth + 12) + 12);
  EXPECT_GT(sheet.height, rows * kHeight);
  std::vector<std::pair<int, int>> places;
  for (const SheetEntry& entry : all) {
    const auto found = placesOf(sheet, entry.picture);
    ASSERT_EQ(found.size(), 1u);
    places.push_back(found.front());
  }
  const auto step = [&](std::size_t from, std::size_t to) {
    return std::pair{places[to].first - places[from].first,
                     places[to].second - places[from].second};
  };
  for (int i = 1; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i % columns != 0) {
      EXPECT_EQ(step(k - 1, k), std::make_pair(kWidth + 8, 0));
    } else {
      EXPECT_EQ(places[k].first, places.front().first);
      // Room for the caption in between.
      EXPECT_GT(places[k].second - places[k - 1].second, kHeight + 10);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, Sheet,
                         testing::Values(std::pair{1, 1}, std::pair{2, 2}, std::pair{5, 3},
                                         std::pair{25, 5}, std::pair{60, 6}));

TEST(ContactSheet, WritesCaptionsBelowAndATitleAbove) {
  const auto all = entries(2);
  const Image sheet = contactSheet(all, "title");
  const auto [left, top] = placesOf(sheet, all.front().picture).front();
  const auto letters = [&, left = left](int from, int to) {
    int count = 0;
    for (int y = from; y < to; ++y) {
      for (int x = left; x < left + kWidth; ++x) count += test::brightness(sheet, x, y) > 300;
    }
    return count;
  };
  EXPECT_GT(letters(0, top), 10);
  EXPECT_GT(letters(top + kHeight, sheet.height), 3);
  auto bare = all;
  for (auto& entry : bare) entry.caption.clear();
  EXPECT_GT(test::differences(sheet, contactSheet(bare, "title")), 3);
  EXPECT_GT(test::differences(sheet, contactSheet(all, "")), 10);
}

}  // namespace
}  // namespace ifa::render
