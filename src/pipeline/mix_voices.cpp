// SPDX-License-Identifier: Apache-2.0
#include "pipeline/mix_voices.h"

#include <algorithm>
#include <cmath>

#include "sonify/room.h"
#include "sonify/sonify.h"
#include "sonify/strike.h"

namespace ifa {

namespace {

constexpr std::uint64_t kFloorSeed = 1;  // one floor for all

Result<SoundMaterial> materialOf(const PlannedVoice& voice, const Score& score) {
  const auto part = std::find_if(score.parts.begin(), score.parts.end(),
                                 [&](const ScorePart& p) { return p.name == voice.player.part; });
  if (!part->sound.empty()) return findSoundMaterial(part->sound);
  auto own = findSoundMaterial(voice.body.definition.material);
  return own ? own : findSoundMaterial("acrylic");  // as `ifa sonify` does
}

Result<Sound> soundOf(const PlannedVoice& voice, const Score& score, double duration) {
  const auto material = materialOf(voice, score);
  if (!material) return tl::unexpected(material.error());
  const Motion& motion = voice.player.motion;
  SonifySettings settings;
  settings.material = *material;
  settings.floor = soundFloor(motion.object.surface);
  settings.seed = kFloorSeed;
  const auto strikes =
      placeStrikes(strikesOf(motion, voice.body), motion.sound.firstContact, kFloorSeed);
  return StruckBody(voice.body, settings).hit(strikes, duration);
}

void scale(Sound& sound, float factor) {
  for (float& sample : sound.samples) sample *= factor;
}

float peakOf(const Sound& sound) {
  float peak = 0;
  for (const float sample : sound.samples) peak = std::max(peak, std::abs(sample));
  return peak;
}

}  // namespace

Result<VoiceMix> mixVoices(const std::vector<PlannedVoice>& voices, const Score& score,
                           double reverberation) {
  double duration = 0;
  for (const PlannedVoice& voice : voices) {
    const Motion& motion = voice.player.motion;
    duration = std::max(duration, motion.trajectory.back().time + motion.sound.firstContact);
  }
  duration = std::min(duration + kSonifyTail, kSonifyLongest);
  VoiceMix mix;
  mix.whole.rate = kSonifyRate;
  for (const PlannedVoice& voice : voices) {
    auto sound = soundOf(voice, score, duration);
    if (!sound) return tl::unexpected(sound.error());
    mix.whole.samples.resize(sound->samples.size());
    for (std::size_t i = 0; i < sound->samples.size(); ++i) {
      mix.whole.samples[i] += sound->samples[i];
    }
    mix.voices.push_back(std::move(*sound));
  }
  addReverberation(mix.whole, reverberation, kFloorSeed);
  const float before = peakOf(mix.whole);
  setPeak(mix.whole);
  for (Sound& sound : mix.voices) {
    scale(sound, before > 0 ? static_cast<float>(kSonifyPeak) / before : 0);
    // One voice alone can be louder than all together, where they cancel.
    if (const float peak = peakOf(sound); peak > 1) scale(sound, 1 / peak);
  }
  return mix;
}

void placeInMix(const VoiceMix& mix, std::vector<PlannedVoice>& voices) {
  for (PlannedVoice& voice : voices) {
    MotionSound& sound = voice.player.motion.sound;
    sound = {"sound.wav", mix.whole.rate, mix.whole.duration(), sound.firstContact};
  }
}

}  // namespace ifa
