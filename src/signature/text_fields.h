// SPDX-License-Identifier: Apache-2.0
// What the text files of marks have in common: lines, numbers, UTF-8.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ifa/result.h"

namespace ifa {

/// Without spaces and line ends at both ends; tabs, which part fields, stay.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// A number with a dot or a comma, whatever the locale; "nan" and "inf" are numbers here, to be
/// complained of by name.
[[nodiscard]] std::optional<double> numberOf(std::string_view field);

/// In well-formed UTF-8 without zero bytes.
[[nodiscard]] bool isUtf8(std::string_view text);

/// Cuts the next line off `rest`, without its end: CR, LF or both.
[[nodiscard]] std::string_view takeLine(std::string_view& rest);

/// The text without its byte-order mark. Errors: kBadInput for UTF-16 and what is not UTF-8.
[[nodiscard]] Result<std::string_view> checkText(std::string_view text, const std::string& place);

/// A to Z made small; all other bytes stay.
[[nodiscard]] std::string lowerAscii(std::string_view text);

}  // namespace ifa
