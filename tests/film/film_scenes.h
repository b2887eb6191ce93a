// SPDX-License-Identifier: Apache-2.0
// Pictures and sounds whose way through a film can be checked.
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "film/film_writer.h"

namespace ifa::test {

inline FilmSettings smallSettings(double framesPerSecond = 60) {
  FilmSettings settings;
  settings.width = 64;
  settings.height = 48;
  settings.framesPerSecond = framesPerSecond;
  return settings;
}

/// A slope of brightness that moves from frame to frame.
inline Image movingPicture(const FilmSettings& settings, int frame) {
  Image image(settings.width, settings.height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = static_cast<std::uint8_t>(i / 3 % 64 * 3 + i % 3 * 20 +
                                             static_cast<std::size_t>(frame) * 2);
  }
  return image;
}

/// A click without energy above 6 kHz, `time` seconds from its middle.
inline double clickAt(double time) {
  return 0.7 * std::exp(-(time / 0.0004) * (time / 0.0004)) * std::cos(9425 * time);
}

/// Mono; each click's middle is at that sample.
inline Sound clicksAtSamples(const std::vector<int>& samples, int rate, int length) {
  Sound sound;
  sound.rate = rate;
  sound.samples.resize(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) {
    for (const int middle : samples) {
      const double value = clickAt(static_cast<double>(i - middle) / rate);
      sound.samples[static_cast<std::size_t>(i)] += static_cast<float>(value);
    }
  }
  return sound;
}

/// By how many samples a click of a sound that is played at `speed` comes after `expected`
/// (samples), by cross-correlation with parabolic interpolation; at most 40 either way.
inline double clickDelay(const std::vector<float>& sound, double expected, double rate,
                         double speed = 1) {
  constexpr int kReach = 40;
  const int width = static_cast<int>(0.0015 * rate / speed);
  const int middle = static_cast<int>(std::lround(expected));
  std::vector<double> likeness;
  for (int lag = -kReach; lag <= kReach; ++lag) {
    double sum = 0;
    for (int i = -width; i <= width; ++i) {
      const int at = middle + i + lag;
      if (at < 0 || at >= static_cast<int>(sound.size())) continue;
      const double time = (middle + i - expected) / rate * speed;
      sum += sound[static_cast<std::size_t>(at)] * clickAt(time);
    }
    likeness.push_back(sum);
  }
  std::size_t best = 1;
  for (std::size_t i = 1; i + 1 < likeness.size(); ++i)
    if (likeness[i] > likeness[best]) best = i;
  const double a = likeness[best - 1], b = likeness[best], c = likeness[best + 1];
  return static_cast<double>(best) - kReach + (a - c) / (2 * (a - 2 * b + c));
}

inline void require(const Result<void>& result) {
  if (!result) throw std::runtime_error(result.error().text());
}

/// Throws on any error. @return the writer's warning
inline std::string writeFilm(const std::filesystem::path& path, const FilmSettings& settings,
                             int frames, const Sound* sound = nullptr) {
  auto writer = FilmWriter::open(path, settings, sound);
  if (!writer) throw std::runtime_error(writer.error().text());
  for (int i = 0; i < frames; ++i) require(writer->add(movingPicture(settings, i)));
  require(writer->finish());
  return writer->warning();
}

}  // namespace ifa::test
