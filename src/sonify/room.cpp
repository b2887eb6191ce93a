// SPDX-License-Identifier: Apache-2.0
#include "sonify/room.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/random.h"

namespace ifa {
namespace {

constexpr double kPulsesPerSecond = 2000;
constexpr double kPreDelay = 0.002;  // s
constexpr double kEnergyToDirect = 0.25;

struct Pulse {
  std::size_t delay = 0;  ///< samples
  double gain = 0;
};

/// One pulse of random sign at a random place of every two-thousandth of a second.
std::vector<Pulse> tail(double seconds, int rate, std::uint64_t seed) {
  RandomStream random(seed, 0x526f6f6d);
  std::vector<Pulse> pulses;
  double energy = 0;
  const double grid = rate / kPulsesPerSecond;
  for (double from = kPreDelay * rate; from < (kPreDelay + seconds) * rate; from += grid) {
    const double place = from + random.uniform() * grid;
    const double gain = std::pow(10.0, -3 * (place / rate - kPreDelay) / seconds);
    pulses.push_back({static_cast<std::size_t>(place), random.uniform() < 0.5 ? -gain : gain});
    energy += gain * gain;
  }
  for (Pulse& pulse : pulses) pulse.gain *= std::sqrt(kEnergyToDirect / energy);
  return pulses;
}

}  // namespace

void addReverberation(Sound& sound, double seconds, std::uint64_t seed) {
  if (!(seconds > 0)) return;
  const auto more = static_cast<std::size_t>(std::ceil(seconds * sound.rate));
  const std::vector<float> direct = sound.samples;
  std::vector<double> wet(direct.size() + more, 0.0);
  for (const Pulse& pulse : tail(seconds, sound.rate, seed)) {
    const std::size_t count =
        std::min(direct.size(), wet.size() - std::min(wet.size(), pulse.delay));
    for (std::size_t i = 0; i < count; ++i) {
      wet[i + pulse.delay] += pulse.gain * static_cast<double>(direct[i]);
    }
  }
  // Walls and air take the treble first: one pole at 5 kHz.
  const double keep = std::exp(-2 * 3.14159265358979323846 * 5000 / sound.rate);
  double dull = 0;
  sound.samples.resize(wet.size(), 0.0F);
  for (std::size_t i = 0; i < wet.size(); ++i) {
    dull = keep * dull + (1 - keep) * wet[i];
    sound.samples[i] += static_cast<float>(dull);
  }
}

void addNoise(Sound& sound, double ratio, std::uint64_t seed) {
  const auto heard = [](float sample) { return sample != 0.0F; };
  const auto first = std::find_if(sound.samples.begin(), sound.samples.end(), heard);
  const auto last = std::find_if(sound.samples.rbegin(), sound.samples.rend(), heard).base();
  if (first >= last) return;
  double energy = 0;
  for (auto sample = first; sample != last; ++sample) {
    energy += static_cast<double>(*sample) * static_cast<double>(*sample);
  }
  const double power = energy / static_cast<double>(last - first) * std::pow(10.0, -ratio / 10);
  const double largest = std::sqrt(3 * power);  // of a uniform variable with that mean square
  RandomStream random(seed, 0x4e6f6973);
  for (float& sample : sound.samples) {
    sample += static_cast<float>(random.uniform(-largest, largest));
  }
}

}  // namespace ifa
