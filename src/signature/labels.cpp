// SPDX-License-Identifier: Apache-2.0
#include "signature/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/file.h"

namespace ifa {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr std::size_t kMaxLabels = 100000;
constexpr const char* kLayout = "a line is: start, tab, end, tab, text; times in seconds";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \r\n") - first + 1);
}

/// The fields between tabs; several tabs in a row count as one, as in Audacity.
std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  while (!line.empty()) {
    const auto end = std::min(line.find('\t'), line.size());
    if (const auto field = trimmed(line.substr(0, end)); !field.empty()) fields.push_back(field);
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return fields;
}

/// A number with a dot or a comma, whatever the locale; "nan" and "inf" are numbers here, to be
/// complained of by name.
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

/// Bytes that follow the first byte of a UTF-8 character, or -1.
int followersOf(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
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

/// Reads line by line; keeps what one line must know of those before.
class Reader {
 public:
  explicit Reader(std::string place) : place_(std::move(place)) {}

  Result<void> add(std::string_view line) {
    ++line_;
    if (trimmed(line).empty() || fieldsOf(line).empty()) return {};
    if (line.starts_with('\\')) return addFrequencies(line);
    if (labels_.size() == kMaxLabels) {
      return bad(fmt::format("more than {} labels", kMaxLabels), "is this a label track?");
    }
    return addLabel(fieldsOf(line));
  }
  std::vector<Label> take() { return std::move(labels_); }

 private:
  tl::unexpected<Error> bad(std::string message, std::string remedy) const {
    return badInput(std::move(message), fmt::format("{}:{}", place_, line_), std::move(remedy));
  }

  Result<void> addLabel(const std::vector<std::string_view>& fields) {
    const auto start = numberOf(fields[0]);
    if (!start) return bad(fmt::format("'{}' is not a time", fields[0].substr(0, 40)), kLayout);
    Label label;
    const auto end = fields.size() > 1 ? numberOf(fields[1]) : std::nullopt;
    label.start = *start;
    label.end = end.value_or(*start);  // no number: a point label, and the field is its text
    label.line = line_;
    const std::size_t textField = end ? 2 : 1;
    if (fields.size() > textField) label.text = std::string(fields[textField]);
    if (!std::isfinite(label.start) || !std::isfinite(label.end)) {
      return bad("a label's time is not a finite number", "give both times in seconds");
    }
    if (label.end < label.start) {
      return bad("a label ends before it starts", "swap its times");
    }
    labels_.push_back(std::move(label));
    continued_ = false;
    return {};
  }

  /// "\", low, high. Further lines of that kind come from later versions and are skipped, as
  /// Audacity does.
  Result<void> addFrequencies(std::string_view line) {
    if (labels_.empty()) return bad("a frequency line comes before any label", kLayout);
    if (continued_) return {};
    continued_ = true;
    const auto fields = fieldsOf(line);
    Label& label = labels_.back();
    const auto low = fields.size() > 1 ? numberOf(fields[1]) : std::nullopt;
    const auto high = fields.size() > 2 ? numberOf(fields[2]) : std::nullopt;
    if (low && std::isfinite(*low)) label.lowHz = low;
    if (high && std::isfinite(*high)) label.highHz = high;
    return {};
  }

  std::string place_;
  int line_ = 0;
  bool continued_ = false;
  std::vector<Label> labels_;
};

Result<void> checkText(std::string_view text, const std::string& place) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return badInput("is UTF-16 text", place, "save the labels as UTF-8");
  }
  if (!isUtf8(text)) return badInput("is not UTF-8 text", place, "save the labels as UTF-8");
  return {};
}

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string placeOf(const std::string& place, const Label& label, std::size_t index) {
  return label.line > 0 ? fmt::format("{}:{}", place, label.line)
                        : fmt::format("{}, label {}", place, index + 1);
}

}  // namespace

Result<std::vector<Label>> parseLabels(std::string_view text, const std::string& place) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (auto good = checkText(text, place); !good) return tl::unexpected<Error>(good.error());
  Reader reader(place);
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of("\r\n"), text.size());
    const std::size_t next = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    if (auto good = reader.add(text.substr(0, end)); !good) {
      return tl::unexpected<Error>(good.error());
    }
    text.remove_prefix(std::min(next, text.size()));
  }
  auto labels = reader.take();
  if (labels.empty()) {
    return badInput("holds no labels", place, "label the contacts, or leave the label file out");
  }
  return labels;
}

Result<std::vector<Label>> readLabels(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaxBytes);
  if (!text) return tl::unexpected<Error>(text.error());
  return parseLabels(*text, path.string());
}

std::string formatLabels(const std::vector<Label>& labels) {
  std::string text;
  for (const Label& label : labels) {
    text += fmt::format("{:.6f}\t{:.6f}\t{}\n", label.start, label.end, oneLine(label.text));
    if (label.lowHz || label.highHz) {
      text +=
          fmt::format("\\\t{:.6f}\t{:.6f}\n", label.lowHz.value_or(-1), label.highHz.value_or(-1));
    }
  }
  return text;
}

Result<void> writeLabels(const std::filesystem::path& path, const std::vector<Label>& labels) {
  return writeFileAtomically(path, formatLabels(labels));
}

Result<void> checkLabels(const std::vector<Label>& labels, double soundDuration,
                         const std::string& place) {
  if (labels.empty()) return badInput("holds no labels", place, "label the contacts");
  constexpr double kSlack = 0.001;    // a region drawn to the end of the sound
  constexpr double kRounding = 2e-6;  // two labels that touch, written with six decimals
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Label& label = labels[i];
    const auto bad = [&](std::string message, std::string remedy) {
      return badInput(std::move(message), placeOf(place, label, i), std::move(remedy));
    };
    if (!std::isfinite(label.start) || !std::isfinite(label.end) || label.end < label.start) {
      return bad("a label's times are not usable", "give a start and an end not before it");
    }
    if (label.start < 0 || label.start >= soundDuration || label.end > soundDuration + kSlack) {
      return bad(
          fmt::format("the label at {:.6f} to {:.6f} s lies outside the sound (0 to {:.6f} s)",
                      label.start, label.end, soundDuration),
          "are these the labels of this sound?");
    }
    if (i == 0) continue;
    const Label& before = labels[i - 1];
    if (label.start < before.start) {
      return bad(fmt::format("labels are out of order: {:.6f} s comes after {:.6f} s", label.start,
                             before.start),
                 "sort the lines by their start");
    }
    if (before.end > label.start + kRounding) {
      return bad(fmt::format("labels overlap: one starts at {:.6f} s while the one before it lasts "
                             "until {:.6f} s",
                             label.start, before.end),
                 "end the first where the second begins, or make them one");
    }
  }
  return {};
}

bool labelsAreTerminal(const std::vector<Label>& labels) {
  if (labels.empty()) return true;
  std::string text(trimmed(labels.back().text));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return !text.ends_with("non-terminal");
}

}  // namespace ifa
