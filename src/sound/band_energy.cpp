// SPDX-License-Identifier: Apache-2.0
#include "sound/band_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ifa {
namespace {

constexpr std::array<double, 6> kEdgesHz{150, 400, 1500, 4000, 9000, 20000};
constexpr double kHopSeconds = 0.00025;

/// Second-order section, transposed direct form II.
class Biquad {
 public:
  /// Passes all until it is made something else.
  Biquad() = default;

  /// Butterworth (Q = 1/sqrt 2) by the bilinear transform (R. Bristow-Johnson, Audio EQ Cookbook).
  static Biquad butterworth(bool highPass, double cutoffHz, double rate) {
    const double w = 2 * std::numbers::pi * cutoffHz / rate;
    const double alpha = std::sin(w) / std::numbers::sqrt2, cosine = std::cos(w);
    const double gain = 1 / (1 + alpha);
    Biquad filter;
    filter.b0_ = gain * (highPass ? 1 + cosine : 1 - cosine) / 2;
    filter.b1_ = (highPass ? -2 : 2) * filter.b0_;
    filter.b2_ = filter.b0_;
    filter.a1_ = -2 * cosine * gain;
    filter.a2_ = (1 - alpha) * gain;
    return filter;
  }

  double operator()(double in) {
    const double out = b0_ * in + z1_;
    z1_ = b1_ * in - a1_ * out + z2_;
    z2_ = b2_ * in - a2_ * out;
    return out;
  }

 private:
  double b0_ = 1, b1_ = 0, b2_ = 0, a1_ = 0, a2_ = 0, z1_ = 0, z2_ = 0;
};

}  // namespace

BandEnergy::BandEnergy(const Sound& sound, double lowHz, double highHz, std::size_t samplesPerHop)
    : samplesPerHop_(static_cast<double>(samplesPerHop)),
      width_((highHz > 0 ? highHz : sound.rate / 2.0) - lowHz) {
  Biquad high = Biquad::butterworth(true, lowHz, sound.rate);
  Biquad low = highHz > 0 ? Biquad::butterworth(false, highHz, sound.rate) : Biquad();
  sums_.reserve(sound.samples.size() / samplesPerHop + 2);
  double sum = 0;
  for (std::size_t i = 0; i < sound.samples.size(); ++i) {
    if (i % samplesPerHop == 0) sums_.push_back(sum);
    const double value = low(high(static_cast<double>(sound.samples[i])));
    sum += value * value;
  }
  sums_.push_back(sum);
}

double BandEnergy::mean(std::ptrdiff_t from, std::ptrdiff_t to) const {
  const auto last = static_cast<std::ptrdiff_t>(hops());
  from = std::clamp<std::ptrdiff_t>(from, 0, last);
  to = std::clamp<std::ptrdiff_t>(to, 0, last);
  if (to <= from) return 0;
  const double energy = sums_[static_cast<std::size_t>(to)] - sums_[static_cast<std::size_t>(from)];
  return energy / (static_cast<double>(to - from) * samplesPerHop_);
}

std::ptrdiff_t BandEnergies::hopsIn(double seconds) const {
  return std::max<std::ptrdiff_t>(1, std::lround(seconds / hop));
}

BandEnergies bandEnergies(const Sound& sound) {
  BandEnergies energies;
  const double samples = std::max(1.0, std::nearbyint(kHopSeconds * sound.rate));
  energies.hop = samples / sound.rate;
  for (std::size_t b = 0; b + 1 < kEdgesHz.size(); ++b) {
    if (kEdgesHz[b] > 0.4 * sound.rate) break;
    const bool needsLowPass = kEdgesHz[b + 1] < 0.45 * sound.rate;
    energies.bands.emplace_back(sound, kEdgesHz[b], needsLowPass ? kEdgesHz[b + 1] : 0,
                                static_cast<std::size_t>(samples));
  }
  return energies;
}

}  // namespace ifa
