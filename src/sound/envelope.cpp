// SPDX-License-Identifier: Apache-2.0
#include "sound/envelope.h"

#include <algorithm>
#include <cmath>

namespace ifa {
namespace {

/// Index of the first sample at or after `time`, inside the sound.
std::size_t indexAt(const Sound& sound, double time) {
  const double index = std::ceil(time * sound.rate - 1e-6);
  return static_cast<std::size_t>(
      std::clamp(index, 0.0, static_cast<double>(sound.samples.size())));
}

float peakBetween(const Sound& sound, std::size_t from, std::size_t to) {
  float peak = 0;
  for (std::size_t i = from; i < to; ++i) peak = std::max(peak, std::abs(sound.samples[i]));
  return peak;
}

}  // namespace

std::vector<float> envelope(const Sound& sound, double from, double to) {
  const double bins = std::ceil((to - from) / kEnvelopeStep - 1e-6);
  std::vector<float> peaks(static_cast<std::size_t>(std::max(0.0, bins)));
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const double start = from + static_cast<double>(k) * kEnvelopeStep;
    const double end = std::min(to, from + static_cast<double>(k + 1) * kEnvelopeStep);
    peaks[k] = peakBetween(sound, indexAt(sound, start), indexAt(sound, end));
  }
  return peaks;
}

std::vector<float> envelope(const Sound& sound) { return envelope(sound, 0, sound.duration()); }

float peakAmplitude(const Sound& sound, double from, double to) {
  const auto nearest = static_cast<std::size_t>(std::max(0.0, std::nearbyint(from * sound.rate)));
  const float first = nearest < sound.samples.size() ? std::abs(sound.samples[nearest]) : 0.0F;
  return std::max(first, peakBetween(sound, indexAt(sound, from), indexAt(sound, to)));
}

}  // namespace ifa
