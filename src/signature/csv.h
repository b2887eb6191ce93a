// SPDX-License-Identifier: Apache-2.0
// Contacts as a table with one row each (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ifa/result.h"
#include "signature/labels.h"

namespace ifa {

/// Columns time, duration, amplitude, label, in that order or, under a line of names, in any:
/// `time` (or `start`), `duration` or `end`, `amplitude`, `centroid`, `weight`, `label` (or
/// `text`); other names are skipped. Fields between tabs, semicolons or commas, whichever the first
/// line has first in this list; quoted as usual. A comma may be the decimal sign where it parts no
/// fields. Lines that begin with # say nothing. Labels come in the file's order.
/// @param place  named in errors together with the line
/// Errors: kBadInput for a field that is not a finite number, a number out of its range, no column
/// of times, text that is not UTF-8, more than kMaxLabels rows, none at all.
[[nodiscard]] Result<std::vector<Label>> parseCsv(std::string_view text, const std::string& place);

/// Reads a file of at most 16 MiB.
[[nodiscard]] Result<std::vector<Label>> readCsv(const std::filesystem::path& path);

/// A line of names, then time, duration (nine decimals), amplitude, centroid, weight and label of
/// each; what a label does not have stays empty.
[[nodiscard]] std::string formatCsv(const std::vector<Label>& labels, char separator = ',');

}  // namespace ifa
