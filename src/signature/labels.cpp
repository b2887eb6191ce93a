// SPDX-License-Identifier: Apache-2.0
#include "signature/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "signature/text_fields.h"

namespace ifa {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr const char* kLayout = "a line is: start, tab, end, tab, text; times in seconds";

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
  auto rest = checkText(text, place);
  if (!rest) return tl::unexpected<Error>(rest.error());
  Reader reader(place);
  while (!rest->empty()) {
    if (auto good = reader.add(takeLine(*rest)); !good) {
      return tl::unexpected<Error>(good.error());
    }
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
  return !lowerAscii(trimmed(labels.back().text)).ends_with("non-terminal");
}

}  // namespace ifa
