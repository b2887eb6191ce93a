// SPDX-License-Identifier: Apache-2.0
// What a sound is to the page: samples that a browser plays, and the contacts in it. Done in a
// process of its own, since it reads a file from anywhere.
#pragma once

#include <filesystem>

#include "ifa/result.h"

namespace ifa::studio {

/// Longest sound that the studio takes, s.
inline constexpr double kMaxSoundSeconds = 300;

/// Writes `folder`/sound.wav and `folder`/heard.json: {"rate", "duration", "contacts": [{"start",
/// "end", "confidence"}]}; the list is empty where nothing is an attack. Errors: those of
/// readSound.
[[nodiscard]] Result<void> hearSound(const std::filesystem::path& sound,
                                     const std::filesystem::path& folder);

}  // namespace ifa::studio
