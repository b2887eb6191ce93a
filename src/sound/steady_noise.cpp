// SPDX-License-Identifier: Apache-2.0
#include "sound/steady_noise.h"

#include <algorithm>
#include <cmath>

namespace ifa {
namespace {

/// Degrees of freedom of the energy of white noise in a band over some time: two for every
/// oscillation that fits, one at least.
double freedomOf(const BandEnergy& band, double seconds) {
  return std::max(1.0, 2 * band.width() * seconds);
}

/// What share of its mean the lowest fiftieth of a chi-square variable reaches (Wilson and Hilferty
/// 1931: its cube root is nearly normal).
double lowestOfNoise(double freedom) {
  constexpr double kFiftieth = -2.0537;  // of a normal variable
  constexpr double kOfOne = 0.09;        // the cube root for one degree, where that is not near
  const double variance = 2 / (9 * freedom);
  return std::pow(std::max(kOfOne, 1 - variance + kFiftieth * std::sqrt(variance)), 3);
}

/// Energy of the noise that is always there. Decision: by the lowest fiftieth of what is heard; a
/// tenth is more than some recordings have between their contacts.
double noiseOf(const BandEnergy& band, std::ptrdiff_t window, double seconds) {
  return lowestOf(band, window, 0.02) / lowestOfNoise(freedomOf(band, seconds));
}

}  // namespace

double lowestOf(const BandEnergy& band, std::ptrdiff_t window, double share) {
  std::vector<double> energies(band.hops());
  for (std::size_t k = 0; k < energies.size(); ++k) {
    const auto start = static_cast<std::ptrdiff_t>(k);
    energies[k] = band.mean(start, start + window);
  }
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(energies.size()));
  std::nth_element(energies.begin(), energies.begin() + place, energies.end());
  return energies[static_cast<std::size_t>(place)];
}

double meanBefore(const BandEnergy& band, std::ptrdiff_t now, std::ptrdiff_t hops,
                  double background) {
  const auto known = static_cast<double>(std::min(now, hops));
  const auto all = static_cast<double>(hops);
  return (band.mean(now - hops, now) * known + background * (all - known)) / all;
}

std::vector<double> unlikelyAsNoise(const BandEnergies& energies, const NoiseSettings& settings) {
  const auto after = energies.hopsIn(settings.after), before = energies.hopsIn(settings.before);
  std::vector<double> unlikely(energies.hops(), 0.0);
  for (const BandEnergy& band : energies.bands) {
    const double noise = noiseOf(band, before, settings.before);
    if (noise < settings.floor) continue;
    const double halfFreedom = freedomOf(band, settings.after) / 2;
    for (std::size_t k = 0; k < unlikely.size(); ++k) {
      const auto now = static_cast<std::ptrdiff_t>(k);
      const double there = std::max(noise, meanBefore(band, now, before, noise));
      const double rise = band.mean(now, now + after) / there;
      if (rise <= 1) continue;
      const double ratio = rise * std::pow(there / noise, -settings.ringSlope);
      if (ratio > 1) unlikely[k] += halfFreedom * (ratio - 1 - std::log(ratio));
    }
  }
  return unlikely;
}

}  // namespace ifa
