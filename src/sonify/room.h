// SPDX-License-Identifier: Apache-2.0
// What a room adds to a sound.
#pragma once

#include <cstdint>

#include "sound/sound.h"

namespace ifa {

/// Adds reverberation that falls by 60 dB in `seconds`: exponentially decaying noise (Moorer 1979)
/// of sparse pulses (velvet noise; Karjalainen and Jarvelainen 2007), which begins 2 ms after the
/// direct sound and carries a quarter of its energy, as at half the critical distance, before a low
/// pass at 5 kHz for what air and walls take. The sound grows by `seconds`. One channel.
void addReverberation(Sound& sound, double seconds, std::uint64_t seed);

/// Adds white noise, `ratio` dB under the mean energy of the sound between its first and last
/// moment that is not silent. One channel.
void addNoise(Sound& sound, double ratio, std::uint64_t seed);

}  // namespace ifa
