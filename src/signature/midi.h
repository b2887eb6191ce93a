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

/// One note of a score.
struct ScoreNote {
  double time = 0;           ///< s from the start of the file
  int track = 1;             ///< from 1, in the file's order
  int channel = 1, key = 0;  ///< 1 to 16; 0 to 127
  double velocity = 1;       ///< 0 to 1
};

/// Every note by itself, in order of time (then of track and key), for who gives them to several
/// bodies. Errors: as parseMidi; kBadInput for format 2, whose tracks do not play together.
[[nodiscard]] Result<std::vector<ScoreNote>> parseMidiNotes(std::string_view bytes,
                                                            const std::string& place);
[[nodiscard]] Result<std::vector<ScoreNote>> readMidiNotes(const std::filesystem::path& path);

}  // namespace ifa
