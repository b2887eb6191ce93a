// SPDX-License-Identifier: Apache-2.0
#include "sonify/sonify.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/random.h"
#include "sonify/block_modes.h"
#include "sonify/contact_force.h"
#include "sonify/room.h"

namespace ifa {
namespace {

using Signal = std::vector<double>;

constexpr double kSoundSpeed = 343;   // m/s
constexpr double kLowestHz = 80;      // a small thing on a floor radiates nothing below
constexpr double kHighestHz = 20000;  // nobody hears more
constexpr double kFloorHighestHz = 12000;
constexpr double kAirDecay = 30;  // 1/s, of every mode: radiation and what holds the body
constexpr std::size_t kMostModes = 400;
/// A touch that lasts longer is too soft to be heard, s.
constexpr double kLongestBlow = 0.05;

/// A damped oscillation: every unit of input starts exp(-decay t) sin(2 pi f t).
class Resonator {
 public:
  Resonator(double frequency, double decay, int rate) {
    const double shrink = std::exp(-decay / rate);
    const double angle = 2 * std::numbers::pi * frequency / rate;
    a1_ = 2 * shrink * std::cos(angle);
    a2_ = -shrink * shrink;
    gain_ = shrink * std::sin(angle);
  }
  double operator()(double in) {
    const double out = a1_ * y1_ + a2_ * y2_ + x1_ * gain_;
    x1_ = in;
    y2_ = y1_;
    y1_ = out;
    return out;
  }

 private:
  double a1_ = 0, a2_ = 0, gain_ = 0, x1_ = 0, y1_ = 0, y2_ = 0;
};

/// A strike as it is heard.
struct Blow {
  Strike strike;
  ForcePulse pulse;
};

void add(const ForcePulse& pulse, double gain, Signal& signal) {
  for (std::size_t i = 0; i < pulse.force.size() && pulse.first + i < signal.size(); ++i) {
    signal[pulse.first + i] += gain * pulse.force[i];
  }
}

// Sound pressures below lack the common factor (density of air) / (distance of the listener).

/// The body's own acceleration pushes the air: a small sphere that is moved to and fro.
void addPushedAir(const Body& body, const Signal& force, Signal& out) {
  const double radius = body.size / 2;
  const double gain = radius * radius * radius / (2 * kSoundSpeed * body.mass) * kSonifyRate;
  for (std::size_t i = 1; i < out.size(); ++i) out[i] += gain * (force[i] - force[i - 1]);
}

/// The floor: a plate that answers at once by its mass alone, then by its modes, which lie at equal
/// distances in frequency but for chance, and each at a random place of its shape.
void addFloor(const SoundFloor& floor, std::uint64_t seed, const Signal& force, Signal& out) {
  const double areaMass = floor.material.density * floor.thickness;
  const double direct = 1 / (2 * std::numbers::pi * areaMass);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += direct * force[i];
  const double waveSpeed = std::sqrt(floor.material.young / floor.material.density);
  const double spacing = floor.thickness * waveSpeed / (std::sqrt(3.0) * floor.area);
  const double gain = kSoundSpeed * std::sqrt(floor.area / (2 * std::numbers::pi)) /
                      (areaMass * floor.area) / kSonifyRate;
  RandomStream random(seed, 0x466c6f6f);
  std::size_t count = 0;
  for (double f = kLowestHz; f < kFloorHighestHz && count < kMostModes; f += spacing, ++count) {
    const double frequency = f + spacing * random.uniform();
    const double decay = std::numbers::pi * frequency * floor.material.loss + kAirDecay;
    Resonator resonator(frequency, decay, kSonifyRate);
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    const double shape = 2 * std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += gain * shape * resonator(force[i]);
  }
}

/// How loud a mode is whose surface moves with a velocity of 1: what moves to and fro cancels where
/// the body is small against the wave.
double loudness(const Block& block, const BlockMode& mode) {
  const double area = 2 * block.sides.prod() * block.sides.cwiseInverse().sum();
  const double omega = 2 * std::numbers::pi * mode.frequency();
  const double size = omega / kSoundSpeed * block.sides.maxCoeff() / 2;
  const double radiation = size * size / (1 + size * size);
  return radiation * area / (4 * std::numbers::pi) * mode.surfaceMotion() * omega;
}

/// A force that only pushes has a mean; no sound has.
void removeMean(Signal& signal) {
  const double keep = std::exp(-2 * std::numbers::pi * kLowestHz / kSonifyRate);
  double before = 0, out = 0;
  for (double& sample : signal) {
    out = keep * (out + sample - before);
    before = sample;
    sample = out;
  }
}

}  // namespace

void setPeak(Sound& sound) {
  float peak = 0;
  for (const float sample : sound.samples) peak = std::max(peak, std::abs(sample));
  if (!(peak > 0)) return;
  for (float& sample : sound.samples) sample *= static_cast<float>(kSonifyPeak) / peak;
}

StruckBody::StruckBody(const Body& body, const SonifySettings& settings)
    : body_(body),
      material_(settings.material),
      floor_(settings.floor),
      seed_(settings.seed),
      block_(blockLike(body, material_)),
      modes_(blockModes(block_, kHighestHz)) {}

Sound StruckBody::hit(const std::vector<Strike>& strikes, double duration) const {
  std::vector<Blow> blows;
  for (const Strike& strike : strikes) {
    const double length = contactTime(body_, strike, material_, floor_.material);
    if (length > kLongestBlow) continue;
    blows.push_back({strike, forcePulse(strike.impulse, strike.time, length, kSonifyRate)});
  }
  const auto count = static_cast<std::size_t>(std::ceil(duration * kSonifyRate));
  Signal force(count, 0.0), out(count, 0.0);
  for (const Blow& blow : blows) add(blow.pulse, 1, force);
  addPushedAir(body_, force, out);
  addFloor(floor_, seed_, force, out);
  for (const BlockMode& mode : modes_) {
    Signal input(count, 0.0);
    for (const Blow& blow : blows) {
      add(blow.pulse, mode.shapeAt(blow.strike.point).dot(blow.strike.direction) / kSonifyRate,
          input);
    }
    const double decay = std::numbers::pi * mode.frequency() * material_.loss + kAirDecay;
    const double gain = loudness(block_, mode);
    Resonator resonator(mode.frequency(), decay, kSonifyRate);
    for (std::size_t i = 0; i < count; ++i) out[i] += gain * resonator(input[i]);
  }
  removeMean(out);
  Sound sound;
  sound.rate = kSonifyRate;
  sound.samples.assign(out.begin(), out.end());
  return sound;
}

std::vector<Strike> placeStrikes(std::vector<Strike> strikes, double lead, std::uint64_t seed) {
  RandomStream random(seed, 0x426c6f77);
  for (Strike& strike : strikes) {
    strike.time += lead + strike.duration * random.uniform();
    strike.duration = 0;
  }
  strikes.erase(std::remove_if(strikes.begin(), strikes.end(),
                               [](const Strike& strike) {
                                 return strike.time < 0 ||
                                        strike.time > kSonifyLongest - kSonifyTail;
                               }),
                strikes.end());
  return strikes;
}

Sound sonify(const Body& body, const std::vector<Strike>& strikes, const SonifySettings& settings) {
  const auto placed = placeStrikes(strikes, settings.lead, settings.seed);
  double duration = std::min(settings.duration, kSonifyLongest);
  for (const Strike& strike : placed) duration = std::max(duration, strike.time + kSonifyTail);
  Sound sound = StruckBody(body, settings).hit(placed, duration);
  addReverberation(sound, settings.reverberation, settings.seed);
  setPeak(sound);
  return sound;
}

}  // namespace ifa
