// SPDX-License-Identifier: Apache-2.0
// A contact sheet: one picture a contact, with its number and time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/image.h"

namespace ifa::render {

/// A picture of the sheet and what is written below it.
struct SheetEntry {
  Image picture;
  std::string caption;
};

/// Pictures in rows, on dark grey, with captions below and a title above.
/// @param entries  at least one, all of one size
[[nodiscard]] Image contactSheet(const std::vector<SheetEntry>& entries, const std::string& title);

/// Columns that make the sheet of `count` pictures about as wide as a page is.
[[nodiscard]] int sheetColumns(int count);

}  // namespace ifa::render
