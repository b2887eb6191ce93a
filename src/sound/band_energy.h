// SPDX-License-Identifier: Apache-2.0
// The energy of a sound in a few frequency bands, in steps short enough to time an attack.
#pragma once

#include <cstddef>
#include <vector>

#include "sound/sound.h"

namespace ifa {

/// Energy of one band, as running sums, so that the mean over any interval is one subtraction.
class BandEnergy {
 public:
  /// Second-order Butterworth high pass at `lowHz` and low pass at `highHz` (0: none).
  BandEnergy(const Sound& sound, double lowHz, double highHz, std::size_t samplesPerHop);

  /// Mean square over hops [from, to), cut to the sound; 0 where nothing is left.
  [[nodiscard]] double mean(std::ptrdiff_t from, std::ptrdiff_t to) const;
  [[nodiscard]] std::size_t hops() const { return sums_.size() - 1; }
  /// Hz between its edges.
  [[nodiscard]] double width() const { return width_; }

 private:
  std::vector<double> sums_;  ///< of squares over the hops before each; one more than hops
  double samplesPerHop_;
  double width_;
};

/// The bands of a sound below its Nyquist frequency, and their common time steps.
struct BandEnergies {
  std::vector<BandEnergy> bands;
  double hop = 0;  ///< s, about 0.25 ms and a whole number of samples

  [[nodiscard]] std::size_t hops() const { return bands.front().hops(); }
  /// Whole hops nearest to `seconds`, at least one.
  [[nodiscard]] std::ptrdiff_t hopsIn(double seconds) const;
};

/// Five bands from 150 Hz to 20 kHz. The upper four are each about eight auditory filters wide
/// (Glasberg and Moore 1990); the lowest hears dull thumps. What lies lower is hum, and too slow to
/// be timed.
[[nodiscard]] BandEnergies bandEnergies(const Sound& sound);

}  // namespace ifa
