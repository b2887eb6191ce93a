// SPDX-License-Identifier: Apache-2.0
// Marks of any kind, in and out: label tracks, cue points, tables, signatures, MIDI.
#pragma once

#include <filesystem>
#include <vector>

#include "ifa/contact_signature.h"
#include "ifa/midi_options.h"
#include "ifa/result.h"
#include "signature/labels.h"
#include "sound/sound.h"

namespace ifa {

enum class MarkFormat {
  kAudacity,   ///< whatever is none of the others
  kWav,        ///< cue points
  kCsv,        ///< .csv, .tsv
  kSignature,  ///< .json
  kMidi        ///< .mid, .midi; not written
};

/// The kind of a file that is there, by its first bytes where they tell, else by its name's ending;
/// of one that is not there, by its ending (any case).
[[nodiscard]] MarkFormat markFormatOf(const std::filesystem::path& path);

/// True where the marks of such a file need no sound: they tell their own amplitudes.
[[nodiscard]] bool standsAlone(MarkFormat format);

/// Reads marks of any kind, in the file's time. Errors: those of its reader; kBadInput for a WAV
/// file without cue points.
[[nodiscard]] Result<std::vector<Label>> readMarks(const std::filesystem::path& path,
                                                   const MidiOptions& options = {});

/// Writes the contacts of a sound by the ending of `path`: .wav gets the sound with the labels as
/// cue points, .csv and .json (and .tsv) the signature, any other the labels as a label track.
/// @param source  the file that `sound` was read from
/// Errors: kUsage for MIDI; kBadInput when the file cannot be written, or the sound is silent at
/// the first contact.
[[nodiscard]] Result<void> writeMarks(const std::filesystem::path& path,
                                      const std::filesystem::path& source, const Sound& sound,
                                      const std::vector<Label>& labels);

}  // namespace ifa
