// SPDX-License-Identifier: Apache-2.0
#include "render/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "render/canvas.h"

namespace ifa::render {
namespace {

constexpr Paint kGround{0.11, 0.11, 0.12, 1};
constexpr Paint kLetters{0.9, 0.9, 0.9, 1};
constexpr int kGap = 8;

}  // namespace

int sheetColumns(int count) {
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))), 1, 6);
}

Image contactSheet(const std::vector<SheetEntry>& entries, const std::string& title) {
  const Image& first = entries.front().picture;
  const int count = static_cast<int>(entries.size()), columns = sheetColumns(count);
  const int rows = (count + columns - 1) / columns;
  const double size = std::max(10.0, first.height / 13.0);
  const int line = static_cast<int>(1.7 * size), head = static_cast<int>(2.4 * size);
  const int cellWidth = first.width + kGap, cellHeight = first.height + line + kGap;
  Image sheet(columns * cellWidth + kGap, head + rows * cellHeight + kGap);
  {
    Canvas canvas(sheet);
    canvas.rectangle(0, 0, sheet.width, sheet.height, kGround);
    canvas.text(kGap, 1.6 * size, 1.2 * size, Align::kLeft, title, kLetters);
    for (int i = 0; i < count; ++i) {
      const int left = kGap + i % columns * cellWidth, top = head + i / columns * cellHeight;
      canvas.text(left, top + first.height + 1.2 * size, size, Align::kLeft,
                  entries[static_cast<std::size_t>(i)].caption, kLetters);
    }
  }
  for (int i = 0; i < count; ++i) {
    paste(entries[static_cast<std::size_t>(i)].picture, sheet, kGap + i % columns * cellWidth,
          head + i / columns * cellHeight);
  }
  return sheet;
}

}  // namespace ifa::render
