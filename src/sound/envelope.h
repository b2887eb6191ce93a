// SPDX-License-Identifier: Apache-2.0
// How loud a sound is, millisecond by millisecond.
#pragma once

#include <vector>

#include "sound/sound.h"

namespace ifa {

/// Width of one bin of an envelope, s; the rate at which motions are simulated (IFA section 3).
inline constexpr double kEnvelopeStep = 0.001;

/// Largest |sample| of each millisecond of [from, to), the last bin perhaps shorter. Times in s
/// from the start of the sound; what lies outside the sound counts as silence.
[[nodiscard]] std::vector<float> envelope(const Sound& sound, double from, double to);

/// Of the whole sound.
[[nodiscard]] std::vector<float> envelope(const Sound& sound);

/// Largest |sample| in [from, to), s; 0 where there is none. The sample nearest to `from` counts
/// even when the interval is shorter than one sample.
[[nodiscard]] float peakAmplitude(const Sound& sound, double from, double to);

}  // namespace ifa
