// SPDX-License-Identifier: Apache-2.0
#include "render/canvas.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scenes.h"
#include "support/pixels.h"
#include "support/read_png.h"
#include "support/temporary_folder.h"

namespace ifa::render {
namespace {

namespace fs = std::filesystem;
using test::pixelAt;

Image noise(int width, int height) {
  Image image(width, height);
  test::Lottery lottery;
  for (auto& value : image.rgb) value = static_cast<std::uint8_t>(lottery.between(0, 256));
  return image;
}

/// First and one past the last row in which two pictures differ.
std::pair<int, int> changedRows(const Image& a, const Image& b) {
  std::pair<int, int> rows{a.height, 0};
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (pixelAt(a, x, y) == pixelAt(b, x, y)) continue;
      rows = {std::min(rows.first, y), y + 1};
    }
  }
  return rows;
}

TEST(Png, ReadsBackAsItWas) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{64, 48}, {1, 1}, {67, 3}}) {
    const Image image = noise(width, height);
    ASSERT_TRUE(writePng(folder / "a.png", image));
    const Image read = test::readPng(folder / "a.png");
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.rgb, image.rgb);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST(Png, WhatCannotBeWrittenLeavesNothing) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "file", "x");
  for (const fs::path& path :
       {folder / "missing/a.png", folder / "file/a.png", fs::path("/proc/a.png")}) {
    const auto result = writePng(path, noise(8, 8));
    ASSERT_FALSE(result) << path;
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
    EXPECT_NE(result.error().text().find(path.string()), std::string::npos);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(Png, AFolderThatMayNotBeWrittenIsTold) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const auto result = writePng(folder / "locked/a.png", noise(8, 8));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  fs::permissions(folder / "locked", fs::perms::owner_all);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"locked"});
}

TEST(Canvas, LeavesAloneWhatIsNotDrawnOn) {
  const Image before = noise(64, 48);
  Image image = before;
  { const Canvas canvas(image); }
  EXPECT_EQ(image.rgb, before.rgb);
}

TEST(Canvas, DrawsInItsRowsOnly) {
  const Image before = noise(64, 48);
  Image image = before;
  {
    Canvas canvas(image, 20, 10);
    canvas.rectangle(-10, -10, 200, 200, {0, 0, 0, 1});
    canvas.disc(32, 25, 40, {1, 0, 0, 1});
    canvas.text(2, 28, 30, Align::kLeft, "Hxgq", {1, 1, 1, 1});
  }
  EXPECT_EQ(changedRows(before, image), std::make_pair(20, 30));
}

TEST(Canvas, PutsRectanglesAndDiscsWhereTheyBelong) {
  Image image(40, 30);
  {
    Canvas canvas(image, 5, 25);
    canvas.rectangle(10, 8, 4, 3, {1, 0.5, 0, 1});
    canvas.disc(30, 20, 4, {0, 0, 1, 1});
  }
  EXPECT_EQ(pixelAt(image, 10, 8), (std::array{255, 128, 0}));
  EXPECT_EQ(pixelAt(image, 13, 10), (std::array{255, 128, 0}));
  for (const auto& [x, y] : {std::pair{9, 8}, {14, 8}, {10, 7}, {10, 11}}) {
    EXPECT_EQ(pixelAt(image, x, y), (std::array{0, 0, 0})) << x << ", " << y;
  }
  EXPECT_EQ(pixelAt(image, 30, 20), (std::array{0, 0, 255}));
  EXPECT_EQ(pixelAt(image, 30, 17), (std::array{0, 0, 255}));
  EXPECT_EQ(pixelAt(image, 30, 25), (std::array{0, 0, 0}));
}

TEST(Canvas, CoversAsMuchAsItIsTold) {
  Image image(8, 8);
  { Canvas(image).rectangle(0, 0, 8, 8, {1, 1, 1, 0.5}); }
  EXPECT_NEAR(pixelAt(image, 3, 3)[0], 128, 1);
}

TEST(Canvas, DrawsABarAColumn) {
  Image image(10, 20);
  { Canvas(image).bars(2, {5, 8, 12}, {10, 4, 12}, {1, 1, 1, 1}); }
  for (int y = 0; y < 20; ++y) {
    EXPECT_EQ(pixelAt(image, 1, y)[0], 0);
    EXPECT_EQ(pixelAt(image, 2, y)[0], y >= 5 && y < 10 ? 255 : 0) << y;
    EXPECT_EQ(pixelAt(image, 3, y)[0], y >= 4 && y < 8 ? 255 : 0) << y << ", upside down";
    EXPECT_EQ(pixelAt(image, 4, y)[0], 0) << y << ", without a height";
  }
}

TEST(Canvas, AlignsText) {
  // Columns that a text covers, from and to.
  const auto covered = [](Align align) {
    Image image(200, 40);
    { Canvas(image).text(100, 30, 16, align, "12.345 s", {1, 1, 1, 1}); }
    std::pair<int, int> columns{200, 0};
    for (int x = 0; x < 200; ++x) {
      for (int y = 0; y < 40; ++y) {
        if (pixelAt(image, x, y)[0] < 60) continue;
        columns = {std::min(columns.first, x), x};
      }
    }
    return columns;
  };
  Image image(8, 8);
  const double width = Canvas(image).textWidth(16, "12.345 s");
  EXPECT_GT(width, 40);
  EXPECT_LT(width, 100);
  const auto left = covered(Align::kLeft), middle = covered(Align::kMiddle),
             right = covered(Align::kRight);
  EXPECT_GE(left.first, 99);
  EXPECT_NEAR(left.second, 100 + width, 4);
  EXPECT_LE(right.second, 101);
  EXPECT_NEAR(right.first, 100 - width, 4);
  EXPECT_NEAR(0.5 * (middle.first + middle.second), 100, 4);
}

}  // namespace
}  // namespace ifa::render
