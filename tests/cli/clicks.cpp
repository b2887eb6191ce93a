// SPDX-License-Identifier: Apache-2.0
#include "clicks.h"

#include <fmt/core.h>
#include <sndfile.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace ifa::test {

namespace {

constexpr int kRate = 44100;

// Starts with its loudest sample, so that the time of the contact is the time of the click.
void addClick(std::vector<short>& samples, const Click& click) {
  const auto first = static_cast<std::size_t>(std::lround(click.time * kRate));
  for (std::size_t i = 0; i < 400 && first + i < samples.size(); ++i) {
    const double time = static_cast<double>(i) / kRate;
    const double value =
        click.level * std::exp(-time / 0.0015) * std::cos(time * 2.0 * 3.14159 * 2500);
    samples[first + i] = static_cast<short>(std::lround(value * 32000));
  }
}

}  // namespace

void writeClicks(const std::filesystem::path& path, const std::vector<Click>& clicks,
                 double seconds) {
  std::vector<short> samples(static_cast<std::size_t>(seconds * kRate), 0);
  for (const Click& click : clicks) addClick(samples, click);
  SF_INFO info{};
  info.samplerate = kRate;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  if (file == nullptr) throw std::runtime_error("cannot write " + path.string());
  sf_writef_short(file, samples.data(), static_cast<sf_count_t>(samples.size()));
  sf_close(file);
}

void writeClickLabels(const std::filesystem::path& path, const std::vector<Click>& clicks) {
  std::ofstream stream(path);
  for (std::size_t i = 0; i < clicks.size(); ++i) {
    const bool last = i + 1 == clicks.size();
    stream << fmt::format("{0:.6f}\t{0:.6f}\t{1}\n", clicks[i].time, last ? "terminal" : "hit");
  }
}

}  // namespace ifa::test
