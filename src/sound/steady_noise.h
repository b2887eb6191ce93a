// SPDX-License-Identifier: Apache-2.0
// What a steady noise does to rises of energy: how likely it would rise as much by itself.
#pragma once

#include <cstddef>
#include <vector>

#include "sound/band_energy.h"

namespace ifa {

/// What the lowest `share` of a band's energies, each over `window` hops, do not exceed.
[[nodiscard]] double lowestOf(const BandEnergy& band, std::ptrdiff_t window, double share);

/// Mean energy over the `hops` before `now`, with `background` where the sound has not begun.
[[nodiscard]] double meanBefore(const BandEnergy& band, std::ptrdiff_t now, std::ptrdiff_t hops,
                                double background);

struct NoiseSettings {
  double after = 0, before = 0;  ///< s, the windows of a rise
  double floor = 0;              ///< energy of a band that nobody hears
  double ringSlope = 0;          ///< dB asked for every dB by which a band stands over its noise
};

/// At every hop the negative logarithm (base e) of a bound on the probability that noise alone
/// rises so much: energies of noise are chi-square, and by Chernoff's inequality those of n degrees
/// of freedom exceed r times their mean with at most exp(-n/2 (r - 1 - ln r)). Bands that noise
/// covers no more than the floor does say nothing: there a rise tells by itself.
[[nodiscard]] std::vector<double> unlikelyAsNoise(const BandEnergies& energies,
                                                  const NoiseSettings& settings);

}  // namespace ifa
