// SPDX-License-Identifier: Apache-2.0
#include "render/svg_text.h"

#include <cstdint>

namespace ifa {
namespace {

/// Bytes of the UTF-8 sequence that starts at `at`; 0 when there is none.
std::size_t sequenceLength(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::size_t length = byte(at) < 0x80                        ? 1
                             : byte(at) >= 0xC2 && byte(at) < 0xE0  ? 2
                             : byte(at) >= 0xE0 && byte(at) < 0xF0  ? 3
                             : byte(at) >= 0xF0 && byte(at) <= 0xF4 ? 4
                                                                    : 0;
  if (at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  }
  return length;
}

}  // namespace

std::string escapeXml(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequenceLength(text, i);
    const char c = text[i];
    if (length == 0) {
      out += '?';
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (static_cast<std::uint8_t>(c) < 0x20) {
      out += ' ';
    } else {
      out += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out;
}

}  // namespace ifa
