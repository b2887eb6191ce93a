// SPDX-License-Identifier: Apache-2.0
// Cue points of WAV files, with their labels and lengths, as marks (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <vector>

#include "ifa/result.h"
#include "signature/labels.h"
#include "sound/sound.h"

namespace ifa {

/// The cue points of a WAV file in order of time, with what `labl`, `ltxt` and `note` in its list
/// `adtl` say; none where the file is not WAV or has no cue points. Texts that are not UTF-8 are
/// taken for Windows' Latin. Cue points are whole samples; a note of writeWavWithCues tells the
/// rest as long as nobody has moved the point. Errors: those of reading; kBadInput with the byte
/// for more cue points than their chunk holds or than kMaxLabels.
[[nodiscard]] Result<std::vector<Label>> readWavCues(const std::filesystem::path& path);

/// Writes the sound with the labels as cue points, instead of those that it has. A file `source`
/// that is WAV is copied with all its other chunks; any other sound is written anew (writeWav).
/// Atomic. Errors: kBadInput when it cannot be written, or would not fit into a WAV file (4 GiB).
/// @param source  the file that `sound` was read from
[[nodiscard]] Result<void> writeWavWithCues(const std::filesystem::path& path,
                                            const std::filesystem::path& source, const Sound& sound,
                                            const std::vector<Label>& labels);

}  // namespace ifa
