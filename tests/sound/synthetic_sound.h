// SPDX-License-Identifier: Apache-2.0
// Sounds whose contacts are known because we made them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "sound/sound.h"

namespace ifa::test {

struct Burst {
  double time = 0;       ///< s
  double amplitude = 1;  ///< of full scale
  double decay = 0.004;  ///< s in which it falls by a factor e
};

inline Sound silence(double seconds, int rate) {
  Sound sound;
  sound.rate = rate;
  sound.samples.assign(static_cast<std::size_t>(std::lround(seconds * rate)), 0.0F);
  return sound;
}

inline void addNoise(Sound& sound, double amplitude, std::uint64_t seed) {
  RandomStream random(seed, 1);
  for (float& sample : sound.samples) {
    sample += static_cast<float>(random.uniform(-amplitude, amplitude));
  }
}

/// White noise that begins at once and dies away.
inline void addBurst(Sound& sound, const Burst& burst, std::uint64_t seed) {
  RandomStream random(seed, 2);
  const auto first = static_cast<std::size_t>(std::lround(burst.time * sound.rate));
  for (std::size_t i = first; i < sound.samples.size(); ++i) {
    const double age = static_cast<double>(i - first) / sound.rate;
    if (age > 12 * burst.decay) break;
    sound.samples[i] +=
        static_cast<float>(burst.amplitude * std::exp(-age / burst.decay) * random.uniform(-1, 1));
  }
}

inline Sound burstsInNoise(const std::vector<Burst>& bursts, double seconds, int rate, double noise,
                           std::uint64_t seed = 1) {
  Sound sound = silence(seconds, rate);
  if (noise > 0) addNoise(sound, noise, seed);
  for (std::size_t i = 0; i < bursts.size(); ++i) addBurst(sound, bursts[i], seed * 1000 + i);
  return sound;
}

}  // namespace ifa::test
