// SPDX-License-Identifier: Apache-2.0
// Notes of Standard MIDI Files as contacts (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ifa/midi_options.h"
#include "ifa/result.h"
#include "signature/labels.h"

namespace ifa {

/// A label for every moment at which notes start, in order of time: amplitude the largest velocity
/// over 127. Formats 0, 1 and 2; tempo changes, from whichever track; ticks by quarter note or by
/// SMPTE frame; running status; everything that is no note and no tempo is skipped.
/// @param place  named in errors together with the byte
/// Errors: kBadInput for what is no MIDI file, is cut off or damaged, holds no such note, a note
/// later than an hour, more than kMaxLabels moments; also where format 2 holds several tunes and
/// no track is chosen.
[[nodiscard]] Result<std::vector<Label>> parseMidi(std::string_view bytes, const std::string& place,
                                                   const MidiOptions& options = {});

/// Reads a file of at most 16 MiB.
[[nodiscard]] Result<std::vector<Label>> readMidi(const std::filesystem::path& path,
                                                  const MidiOptions& options = {});

}  // namespace ifa
