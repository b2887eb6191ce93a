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
  double rise = 0;   ///< dB by which the attack stands over what was there before it
};

/// See docs/detection.md for where each comes from and what it does.
struct DetectorSettings {
  double minRise = 9;          ///< dB; less is not an attack. Higher: fewer, surer contacts
  double range = 45;           ///< dB under the loudest contact where listening stops
  double minInterval = 0.003;  ///< s; two attacks that are closer are heard as one
  double minDuration = 0.020;  ///< s; a contact that sounds on for less is discrete
};

/// Contacts in order of time. Errors: kBadInput when nothing in the sound is an attack.
[[nodiscard]] Result<std::vector<DetectedContact>> detectContacts(
    const Sound& sound, const DetectorSettings& settings = {});

}  // namespace ifa
