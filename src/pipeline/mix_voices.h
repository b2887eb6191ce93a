// SPDX-License-Identifier: Apache-2.0
// The sound of an ensemble: every body's own, and all together.
#pragma once

#include <vector>

#include "ensemble/score.h"
#include "pipeline/plan_voice.h"
#include "sound/sound.h"

namespace ifa {

struct VoiceMix {
  Sound whole;                ///< its largest sample as of sonify()
  std::vector<Sound> voices;  ///< as loud as in the whole, and as long
};

/// Sounds by modal synthesis (docs/sonify.md), each body of the material that its part names, else
/// of its own. The room is added to the whole only.
/// @param reverberation  s in which the room's echo falls by 60 dB
/// Errors: kUsage for a material that is not known.
[[nodiscard]] Result<VoiceMix> mixVoices(const std::vector<PlannedVoice>& voices,
                                         const Score& score, double reverberation);

/// Sets `sound` of every motion to sound.wav of the mix.
void placeInMix(const VoiceMix& mix, std::vector<PlannedVoice>& voices);

}  // namespace ifa
