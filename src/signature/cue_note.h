// SPDX-License-Identifier: Apache-2.0
// The exact time of a cue point, which is itself a whole sample, in the text of its `note`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ifa {

struct CueNote {
  double start = 0, duration = 0;  ///< s
};

/// "ifa 0.203561250 0.000000000".
[[nodiscard]] std::string formatCueNote(const CueNote& note);
/// Nothing where the text is not such a note.
[[nodiscard]] std::optional<CueNote> parseCueNote(std::string_view text);

/// The sample nearest to a time. @param seconds  0 to 1e9
[[nodiscard]] std::uint64_t samplesAt(double seconds, double rate);
/// Whether that is what samplesAt gave for a time of which `seconds` are the nine decimals of a
/// note: halfway between two samples, rounding may have gone the other way.
[[nodiscard]] bool isAtSample(double seconds, std::uint64_t sample, double rate);

}  // namespace ifa
