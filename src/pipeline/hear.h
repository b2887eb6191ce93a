// SPDX-License-Identifier: Apache-2.0
// First stages of every synchronisation: the sound, and where its contacts lie.
#pragma once

#include <optional>

#include "ifa/contact_signature.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"
#include "sound/sound.h"

namespace ifa {

/// What was heard. A signature file comes without a sound.
struct Heard {
  std::optional<Sound> sound;
  ContactSignature signature;
};

/// Reads the sound and its labels, or detects the contacts where there are none; or reads a
/// signature (a file whose name ends in .json).
/// @param mergeGap  delta t of the object, s (IFA section 4)
/// Errors: those of reading; kUsage for labels beside a signature.
[[nodiscard]] Result<Heard> hear(const SynchronizeSettings& settings, double mergeGap);

/// `sound` after that many samples of silence, on all its channels.
[[nodiscard]] Sound withLeadingSilence(const Sound& sound, std::size_t count);

}  // namespace ifa
