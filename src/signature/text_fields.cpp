// SPDX-License-Identifier: Apache-2.0
#include "signature/text_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace ifa {
namespace {

/// Bytes that follow the first byte of a UTF-8 character, or -1.
int followersOf(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \r\n") - first + 1);
}

std::optional<double> numberOf(std::string_view field) {
  std::string text(field);
  std::replace(text.begin(), text.end(), ',', '.');
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [stop, code] = std::from_chars(begin, end, value);
  if (stop != end || code == std::errc::invalid_argument) return std::nullopt;
  if (code == std::errc::result_out_of_range) return HUGE_VAL;
  return value;
}

bool isUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const int followers = followersOf(static_cast<unsigned char>(text[i++]));
    if (followers < 0 || text[i - 1] == '\0') return false;
    std::uint32_t bits = 0;
    for (int k = 0; k < followers; ++k, ++i) {
      if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return false;
      bits = bits << 6 | (static_cast<unsigned char>(text[i]) & 0x3FU);
    }
    const auto first =
        static_cast<unsigned char>(text[i - static_cast<std::size_t>(followers) - 1]);
    // Too long a form, a half of a UTF-16 pair, or beyond Unicode.
    if (first == 0xE0 && bits < 0x800) return false;
    if (first == 0xED && bits >= 0x800) return false;
    if (first == 0xF0 && bits < 0x10000) return false;
    if (first == 0xF4 && bits >= 0x10000) return false;
  }
  return true;
}

std::string_view takeLine(std::string_view& rest) {
  const auto end = std::min(rest.find_first_of("\r\n"), rest.size());
  const std::string_view line = rest.substr(0, end);
  const std::size_t next = end + (rest.substr(end).starts_with("\r\n") ? 2 : 1);
  rest.remove_prefix(std::min(next, rest.size()));
  return line;
}

Result<std::string_view> checkText(std::string_view text, const std::string& place) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return badInput("is UTF-16 text", place, "save it as UTF-8");
  }
  if (!isUtf8(text)) return badInput("is not UTF-8 text", place, "save it as UTF-8");
  return text;
}

std::string lowerAscii(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return lower;
}

}  // namespace ifa
