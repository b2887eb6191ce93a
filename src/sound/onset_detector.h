// SPDX-License-Identifier: Apache-2.0
// Finds contact events in a recording where nobody has labelled them (docs/detection.md).
#pragma once

#include <vector>

#include "ifa/result.h"
#include "sound/sound.h"

namespace ifa {

/// One contact as heard.
struct DetectedContact {
  double start = 0;  ///< s in the sound file, where the attack begins
  double end = 0;    ///< s; equal to `start` for a discrete contact, later for a rattle or a roll
  double level = 0;  ///< dB relative to the loudest contact, <= 0
  double rise = 0;   ///< dB by which the attack stands over what was there before, mean over bands
  double confidence = 1;  ///< 0 to 1: the share of contacts that are heard so that are true ones
};

/// All that can be tuned; docs/detection.md tells how the defaults were found.
struct DetectorSettings {
  double minRise = 5.5;        ///< dB; a smaller rise is no attack. Higher: fewer, surer contacts
  double lastEase = 0.5;       ///< dB less are asked of what comes after the last such attack
  double range = 40;           ///< dB under the loudest contact where listening stops
  double after = 0.002;        ///< s after a moment in which the attack's energy is taken
  double before = 0.008;       ///< s before it that it is compared with; longer hides more echoes
  double minInterval = 0.004;  ///< s; of two attacks that are closer the steeper one counts
  double leadIn = 30;          ///< dB under the loudest contact; the first one is not softer
  double rattleRise = 3;       ///< dB; rises that, after the last contact, keep a rattle going
  double rattleGap = 0.030;    ///< s; a longer pause between them ends it
  double denseGap = 0.010;     ///< s; contacts at the end with a rise as often are one rattle
  double rattlePause = 0.070;  ///< s; so are those with no longer pause between the rises ...
  int rattleFill = 4;          ///< ... that part them, if these are as many; so many any rattle has
  double falseAlarm = 1e-6;    ///< bound on how probably noise rises like a soft contact; 0: none
  double noiseEase = 3;        ///< dB of a rise that noise may hide
  double ringSlope = 1.0 / 3;  ///< dB more are asked for every dB that something rings above it
};

/// Contacts in order of time; only one near the end may be a region (a rattle or roll, which
/// swallows the contacts in it): the merge filter of a signature joins what is dense elsewhere.
/// Times are multiples of 0.25 ms, give or take half a sample. Errors: kBadInput when nothing in
/// the sound is an attack.
[[nodiscard]] Result<std::vector<DetectedContact>> detectContacts(
    const Sound& sound, const DetectorSettings& settings = {});

}  // namespace ifa
