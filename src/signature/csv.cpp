// SPDX-License-Identifier: Apache-2.0
#include "signature/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/file.h"
#include "signature/text_fields.h"

namespace ifa {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
constexpr const char* kLayout = "a row is: time, duration, amplitude, label; see docs";

enum class Field { kTime, kDuration, kEnd, kAmplitude, kCentroid, kWeight, kLabel, kOther };

Field fieldNamed(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Field>, 9> kNames = {
      {{"time", Field::kTime},
       {"start", Field::kTime},
       {"duration", Field::kDuration},
       {"end", Field::kEnd},
       {"amplitude", Field::kAmplitude},
       {"centroid", Field::kCentroid},
       {"weight", Field::kWeight},
       {"label", Field::kLabel},
       {"text", Field::kLabel}}};
  const std::string lower = lowerAscii(name);
  for (const auto& [known, field] : kNames) {
    if (lower == known) return field;
  }
  return Field::kOther;
}

char separatorOf(std::string_view line) {
  for (const char separator : {'\t', ';'}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

/// The fields of a line; in quotes a separator is text, and two quotes are one.
std::vector<std::string> splitLine(std::string_view line, char separator) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"' && (quoted || trimmed(fields.back()).empty())) {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = std::string(trimmed(field));
  return fields;
}

/// Reads line by line; keeps what the first one says of the others.
class Reader {
 public:
  explicit Reader(std::string place) : place_(std::move(place)) {}

  Result<void> add(std::string_view line) {
    ++line_;
    if (trimmed(line).empty() || line.starts_with('#')) return {};
    if (columns_.empty()) {
      separator_ = separatorOf(line);
      if (!numberOf(splitLine(line, separator_).front())) return readNames(line);
      columns_ = {Field::kTime, Field::kDuration, Field::kAmplitude, Field::kLabel};
    }
    if (labels_.size() == kMaxLabels) {
      return bad(fmt::format("more than {} rows", kMaxLabels), "is this a table of contacts?");
    }
    return readRow(splitLine(line, separator_));
  }
  std::vector<Label> take() { return std::move(labels_); }

 private:
  /// What a number may be.
  struct Range {
    double low, high;
  };

  tl::unexpected<Error> bad(std::string message, std::string remedy) const {
    return badInput(std::move(message), fmt::format("{}:{}", place_, line_), std::move(remedy));
  }

  Result<void> readNames(std::string_view line) {
    bool hasTime = false;
    for (const std::string& name : splitLine(line, separator_)) {
      columns_.push_back(fieldNamed(name));
      hasTime = hasTime || columns_.back() == Field::kTime;
    }
    if (hasTime) return {};
    return bad("neither a time nor the names of columns, of which one is \"time\"", kLayout);
  }

  Result<void> readRow(const std::vector<std::string>& fields) {
    Label label;
    label.line = line_;
    std::optional<double> time, duration, end;
    for (std::size_t i = 0; i < std::min(fields.size(), columns_.size()); ++i) {
      if (columns_[i] == Field::kLabel) label.text = fields[i];
      if (fields[i].empty() || columns_[i] >= Field::kLabel) continue;
      const Range range = rangeOf(columns_[i]);
      const double value = numberOf(fields[i]).value_or(NAN);
      if (!std::isfinite(value) || value < range.low || value > range.high) {
        return bad(fmt::format("\"{}\" is not a number from {:g} to {:g}", fields[i].substr(0, 40),
                               range.low, range.high),
                   kLayout);
      }
      if (columns_[i] == Field::kTime) time = value;
      if (columns_[i] == Field::kDuration) duration = value;
      if (columns_[i] == Field::kEnd) end = value;
      if (columns_[i] == Field::kAmplitude) label.amplitude = value;
      if (columns_[i] == Field::kCentroid) label.centroid = value;
      if (columns_[i] == Field::kWeight) label.weight = value;
    }
    if (!time) return bad("a row has no time", kLayout);
    label.start = *time;
    label.end = duration ? *time + *duration : end.value_or(*time);
    if (label.end < label.start) return bad("a contact ends before it starts", "swap its times");
    labels_.push_back(std::move(label));
    return {};
  }

  /// Times may be up to a day, as sound files that are too long are refused for that.
  static Range rangeOf(Field field) {
    constexpr double kDay = 86400;
    if (field == Field::kWeight) return {0, 1};
    if (field == Field::kAmplitude) return {0, 1e6};
    return {0, kDay};
  }

  std::string place_;
  int line_ = 0;
  char separator_ = ',';
  std::vector<Field> columns_;  ///< empty before the first line
  std::vector<Label> labels_;
};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",;\"\t\r\n") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) {
    if (c == '"') all += '"';
    all += c == '\r' || c == '\n' ? ' ' : c;
  }
  return all + '"';
}

std::string optionalNumber(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : std::string();
}

}  // namespace

Result<std::vector<Label>> parseCsv(std::string_view text, const std::string& place) {
  auto rest = checkText(text, place);
  if (!rest) return tl::unexpected<Error>(rest.error());
  Reader reader(place);
  while (!rest->empty()) {
    if (auto good = reader.add(takeLine(*rest)); !good) return tl::unexpected<Error>(good.error());
  }
  auto labels = reader.take();
  if (labels.empty()) return badInput("holds no contacts", place, kLayout);
  return labels;
}

Result<std::vector<Label>> readCsv(const std::filesystem::path& path) {
  const auto text = readFile(path, kMaxBytes);
  if (!text) return tl::unexpected<Error>(text.error());
  return parseCsv(*text, path.string());
}

std::string formatCsv(const std::vector<Label>& labels, char separator) {
  std::string text = "time,duration,amplitude,centroid,weight,label\n";
  std::replace(text.begin(), text.end(), ',', separator);
  for (const Label& label : labels) {
    text += fmt::format("{:.9f}{s}{:.9f}{s}{}{s}{}{s}{:.9g}{s}{}\n", label.start,
                        label.end - label.start, optionalNumber(label.amplitude),
                        optionalNumber(label.centroid), label.weight, quoted(label.text),
                        fmt::arg("s", separator));
  }
  return text;
}

}  // namespace ifa
