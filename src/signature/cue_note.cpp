// SPDX-License-Identifier: Apache-2.0
#include "signature/cue_note.h"

#include <fmt/format.h>

#include <cmath>

#include "signature/text_fields.h"

namespace ifa {
namespace {

constexpr std::string_view kMark = "ifa ";
constexpr double kMostSeconds = 1e9;

bool isTime(const std::optional<double>& value) {
  return value && *value >= 0 && *value <= kMostSeconds;
}

}  // namespace

std::string formatCueNote(const CueNote& note) {
  return fmt::format("{}{:.9f} {:.9f}", kMark, note.start, note.duration);
}

std::optional<CueNote> parseCueNote(std::string_view text) {
  if (!text.starts_with(kMark)) return std::nullopt;
  text.remove_prefix(kMark.size());
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  const auto start = numberOf(text.substr(0, space));
  const auto duration = numberOf(trimmed(text.substr(space)));
  if (!isTime(start) || !isTime(duration)) return std::nullopt;
  return CueNote{*start, *duration};
}

std::uint64_t samplesAt(double seconds, double rate) {
  return static_cast<std::uint64_t>(std::nearbyint(seconds * rate));
}

bool isAtSample(double seconds, std::uint64_t sample, double rate) {
  constexpr double kRounding = 1e-9;  // s
  return std::abs(seconds * rate - static_cast<double>(sample)) <= 0.5 + kRounding * rate;
}

}  // namespace ifa
