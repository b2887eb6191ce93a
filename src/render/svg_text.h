// SPDX-License-Identifier: Apache-2.0
// Pieces of SVG as text.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace ifa {

/// `text` with &, <, >, quotes and control characters made harmless; bytes that are no UTF-8 become
/// question marks.
[[nodiscard]] std::string escapeXml(std::string_view text);

/// Collects elements. Coordinates are written with one decimal.
class SvgText {
 public:
  template <class... Values>
  void add(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), format, values...);
    text_ += '\n';
  }
  void raw(std::string_view text) { text_ += text; }
  void rectangle(std::string_view kind, double x, double y, double width, double height) {
    add("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", kind,
        x, y, width, height);
  }
  void line(std::string_view kind, double x1, double y1, double x2, double y2) {
    add("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", kind, x1, y1, x2, y2);
  }
  /// @param anchor  "start", "middle" or "end"
  void label(std::string_view kind, double x, double y, std::string_view anchor,
             std::string_view text) {
    add("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", kind, x, y,
        anchor, escapeXml(text));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace ifa
