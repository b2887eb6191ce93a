// SPDX-License-Identifier: Apache-2.0
// Sounds of known contacts for tests. Tests that include this link PkgConfig::SNDFILE.
#pragma once

#include <fmt/core.h>
#include <sndfile.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace ifa::test {

inline constexpr int kClickRate = 44100;

struct Click {
  double time = 0;   ///< s
  double level = 1;  ///< of full scale
};

// Starts with its loudest sample, so that the time of the contact is the time of the click.
inline void addClick(std::vector<short>& samples, const Click& click) {
  const auto first = static_cast<std::size_t>(std::lround(click.time * kClickRate));
  for (std::size_t i = 0; i < 400 && first + i < samples.size(); ++i) {
    const double time = static_cast<double>(i) / kClickRate;
    const double value = click.level * std::exp(-time / 0.0015) * std::cos(time * 15708);
    samples[first + i] = static_cast<short>(std::lround(value * 32000));
  }
}

/// Writes a mono WAV, 44.1 kHz, 16 bit: a short burst that dies away in a few ms at each time.
inline void writeClicks(const std::filesystem::path& path, const std::vector<Click>& clicks,
                        double seconds) {
  std::vector<short> samples(static_cast<std::size_t>(seconds * kClickRate), 0);
  for (const Click& click : clicks) addClick(samples, click);
  SF_INFO info{};
  info.samplerate = kClickRate;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  if (file == nullptr) throw std::runtime_error("cannot write " + path.string());
  sf_writef_short(file, samples.data(), static_cast<sf_count_t>(samples.size()));
  sf_close(file);
}

/// Writes Audacity point labels at these times, the last one terminal and `lastDuration` seconds
/// long.
inline void writeClickLabels(const std::filesystem::path& path, const std::vector<Click>& clicks,
                             double lastDuration = 0) {
  std::ofstream stream(path);
  for (std::size_t i = 0; i < clicks.size(); ++i) {
    const bool last = i + 1 == clicks.size();
    const double end = clicks[i].time + (last ? lastDuration : 0);
    stream << fmt::format("{:.6f}\t{:.6f}\t{}\n", clicks[i].time, end, last ? "terminal" : "hit");
  }
}

}  // namespace ifa::test
