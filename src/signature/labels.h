// SPDX-License-Identifier: Apache-2.0
// Audacity label tracks, with all their oddities (docs/file-formats.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ifa/contact_signature.h"
#include "ifa/result.h"

namespace ifa {

/// Most labels that a file may hold.
inline constexpr std::size_t kMaxLabels = 100000;

/// One label: a point (start = end) or a region of a sound.
struct Label {
  double start = 0;  ///< s in the sound file
  double end = 0;    ///< s, >= start
  std::string text;  ///< UTF-8, without tabs and line ends
  /// Frequencies of a spectral selection, Hz; carried along, not used.
  std::optional<double> lowHz, highHz;
  int line = 0;  ///< in the file, from 1; 0 when it comes from elsewhere
  /// What only some formats tell (SignatureEvent); none: the sound is asked. Any scale will do for
  /// the amplitude, as the first one's becomes 1.
  std::optional<double> amplitude, centroid;
  double weight = 1;
  std::vector<AlternativeStart> alternatives;  ///< in the sound file's time

  [[nodiscard]] bool isPoint() const { return end <= start; }
};

/// Reads the text of a label track: comma or dot decimals, point labels whose second field is text,
/// frequency lines, byte-order mark, any line end, empty lines. Labels come in the file's order.
/// @param place  named in errors together with the line
/// Errors: kBadInput for a field that is not a finite number, an end before its start, a frequency
/// line without a label, text that is not UTF-8, more than 100,000 labels, no label at all.
[[nodiscard]] Result<std::vector<Label>> parseLabels(std::string_view text,
                                                     const std::string& place);

/// Reads a label file of at most 16 MiB; errors as parseLabels, and those of reading.
[[nodiscard]] Result<std::vector<Label>> readLabels(const std::filesystem::path& path);

/// The labels as Audacity writes them: tabs, six decimals, a dot, frequency lines where a label has
/// them. Tabs and line ends in a text become spaces.
[[nodiscard]] std::string formatLabels(const std::vector<Label>& labels);

/// Writes them atomically. Errors: kBadInput when the file cannot be written.
[[nodiscard]] Result<void> writeLabels(const std::filesystem::path& path,
                                       const std::vector<Label>& labels);

/// Whether the labels can be contacts of a sound of that length: in order, apart from each other,
/// inside the sound (an end may stand over by a millisecond). Errors: kBadInput with the line.
[[nodiscard]] Result<void> checkLabels(const std::vector<Label>& labels, double soundDuration,
                                       const std::string& place);

/// True unless the last label's text ends in "non-terminal" (any case): the body comes to rest.
[[nodiscard]] bool labelsAreTerminal(const std::vector<Label>& labels);

}  // namespace ifa
