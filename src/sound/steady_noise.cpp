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

/// What share of its mean the lowest tenth of a chi-square variable reaches (Wilson and Hilferty
/// 1931: its cube root is nearly normal).
double lowestTenthOfNoise(double freedom) {
  constexpr double kTenth = -1.2816;  // of a normal variable
  const double variance = 2 / (9 * freedom);
  return std::pow(1 - variance + kTenth * std::sqrt(variance), 3);
}

}  // namespace

double lowestTenth(const BandEnergy& band, std::ptrdiff_t window) {
  std::vector<double> energies(band.hops());
  for (std::size_t k = 0; k < energies.size(); ++k) {
    const auto start = static_cast<std::ptrdiff_t>(k);
    energies[k] = band.mean(start, start + window);
  }
  const auto tenth = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 10);
  std::nth_element(energies.begin(), tenth, energies.end());
  return *tenth;
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
    const double noise =
        lowestTenth(band, before) / lowestTenthOfNoise(freedomOf(band, settings.before));
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
