// SPDX-License-Identifier: Apache-2.0
// First stages of every synchronisation: the sound, and where its contacts lie.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ifa/contact_signature.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"
#include "sound/sound.h"

namespace ifa {

/// What was heard. A signature, a table or a MIDI file comes without a sound.
struct Heard {
  std::optional<Sound> sound;
  ContactSignature signature;
  std::vector<std::string> remarks;  ///< what the user should know; mostly empty
};

/// Reads the sound and its labels; where there are none, the sound's own cue points; where it has
/// none either, detects the contacts. Or reads a file of contacts alone: a signature, a table,
/// MIDI.
/// @param mergeGap  delta t of the object, s (IFA section 4)
/// Errors: those of reading; kUsage for labels beside a file of contacts alone.
[[nodiscard]] Result<Heard> hear(const SynchronizeSettings& settings, double mergeGap);

/// `sound` after that many samples of silence, on all its channels.
[[nodiscard]] Sound withLeadingSilence(const Sound& sound, std::size_t count);

}  // namespace ifa
