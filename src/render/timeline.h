// SPDX-License-Identifier: Apache-2.0
// The timeline picture: the sound, its contacts and the motion's contacts one below the other.
#pragma once

#include <filesystem>
#include <string>

#include "ifa/motion.h"
#include "ifa/result.h"
#include "sound/sound.h"

namespace ifa {

/// SVG, at most about 200 KB, for light and dark pages: waveform of `sound`, target contacts, the
/// motion's contacts with their amplitudes, factors and bend of each, Score in the caption.
/// @param sound  as used (time 0 = its first sample); without samples the waveform is left out
[[nodiscard]] std::string timelineSvg(const Motion& motion, const Sound& sound);

/// Atomic. Errors: kBadInput when the file cannot be written.
[[nodiscard]] Result<void> writeTimeline(const std::filesystem::path& path, const Motion& motion,
                                         const Sound& sound);

}  // namespace ifa
