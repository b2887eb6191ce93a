// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <system_error>

#include "sound/quiet_stderr.h"
#include "sound/sound.h"

namespace ifa {
namespace {

using File = std::unique_ptr<SNDFILE, int (*)(SNDFILE*)>;

constexpr const char* kConvert = "convert it to WAV, FLAC, Ogg or MP3 and try again";

/// libsndfile's words for its last error, without the full stop.
std::string reasonOf(SNDFILE* file) {
  std::string reason = sf_strerror(file);
  while (reason.ends_with('.') || reason.ends_with(' ')) reason.pop_back();
  // What it says of bytes that look like MP3 and are none; that the file is there was checked.
  if (reason.find("not a regular file") != std::string::npos) return "Format not recognised";
  return reason;
}

/// What can be said about a path before decoding anything.
Result<void> checkPath(const std::filesystem::path& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  const std::string place = path.string();
  if (!std::filesystem::exists(status)) return badInput("no such sound file", place);
  if (std::filesystem::is_directory(status)) return badInput("is a folder, not a sound", place);
  if (!std::filesystem::is_regular_file(status)) return badInput("is not a regular file", place);
  if (std::filesystem::file_size(path, code) == 0 && !code) {
    return badInput("is an empty file", place, "record or export the sound again");
  }
  return {};
}

SampleFormat formatOf(int sndfileFormat) {
  switch (sndfileFormat & SF_FORMAT_SUBMASK) {
    case SF_FORMAT_PCM_24:
      return SampleFormat::kPcm24;
    case SF_FORMAT_PCM_32:
    case SF_FORMAT_FLOAT:
    case SF_FORMAT_DOUBLE:
      return SampleFormat::kFloat;
    default:  // 8 and 16 bits, telephone codes, and what was compressed with loss
      return SampleFormat::kPcm16;
  }
}

Result<void> checkHeader(const SF_INFO& info, const SoundLimits& limits, const std::string& place) {
  // Headerless data is taken on its file name's word by libsndfile: that is no sound to us.
  if ((info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_RAW) {
    return badInput("has no header that says what its samples are", place, kConvert);
  }
  if (info.samplerate < limits.minRate || info.samplerate > limits.maxRate) {
    return badInput(fmt::format("a sample rate of {} Hz is not usable", info.samplerate), place,
                    fmt::format("resample it to {} to {} Hz", limits.minRate, limits.maxRate));
  }
  if (info.channels < 1 || info.channels > limits.maxChannels) {
    return badInput(fmt::format("{} channels are not usable", info.channels), place,
                    fmt::format("mix it down to at most {} channels", limits.maxChannels));
  }
  return {};
}

Result<void> checkLength(std::size_t frames, const Sound& sound, const SoundLimits& limits,
                         const std::string& place) {
  if (static_cast<double>(frames) > limits.maxSeconds * sound.rate) {
    return badInput(fmt::format("is longer than {:g} s", limits.maxSeconds), place,
                    "cut out the part with the contacts");
  }
  const double floats = static_cast<double>(frames) * (sound.channels > 1 ? sound.channels + 1 : 1);
  if (floats * sizeof(float) > limits.maxBytes) {
    return badInput(fmt::format("holds more than {:g} MiB of samples", limits.maxBytes / 1048576),
                    place, "cut it, mix it down or lower its sample rate");
  }
  return {};
}

/// First sample that is no finite number, or `values.size()`.
std::size_t firstBad(const std::vector<float>& values, std::size_t from) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(from);
  const auto bad = std::find_if(begin, values.end(), [](float v) { return !std::isfinite(v); });
  return static_cast<std::size_t>(bad - values.begin());
}

constexpr std::size_t kBlockFrames = 1 << 14;

/// Room for what the header promises, as far as the file can hold it at a byte a sample: a vector
/// that grows holds an hour of sound twice.
void makeRoom(const SF_INFO& info, const std::filesystem::path& path, std::vector<float>& values) {
  std::error_code code;
  const std::uintmax_t bytes = std::filesystem::file_size(path, code);
  if (code || info.frames <= 0) return;
  const double promised = static_cast<double>(info.frames) * info.channels;
  const auto block = kBlockFrames * static_cast<std::size_t>(info.channels);
  if (promised <= static_cast<double>(bytes)) {
    values.reserve(static_cast<std::size_t>(promised) + block);
  }
}

/// All channels into `values`, believing the data and not the header's count of frames.
Result<void> decode(SNDFILE* file, const Sound& sound, const SoundLimits& limits,
                    const std::string& place, std::vector<float>& values) {
  const auto channels = static_cast<std::size_t>(sound.channels);
  for (;;) {
    const std::size_t used = values.size();
    values.resize(used + kBlockFrames * channels);
    const sf_count_t read =
        sf_readf_float(file, values.data() + used, static_cast<sf_count_t>(kBlockFrames));
    values.resize(used + static_cast<std::size_t>(std::max<sf_count_t>(read, 0)) * channels);
    if (const std::size_t bad = firstBad(values, used); bad < values.size()) {
      return badInput(fmt::format("sample {} of channel {} is not a finite number", bad / channels,
                                  bad % channels + 1),
                      place, "export the sound again as 16 or 24 bit WAV");
    }
    if (auto good = checkLength(values.size() / channels, sound, limits, place); !good) return good;
    if (read < static_cast<sf_count_t>(kBlockFrames)) break;
  }
  if (sf_error(file) != SF_ERR_NO_ERROR) {
    return badInput("is damaged: " + reasonOf(file), place, kConvert);
  }
  if (values.empty()) {
    return badInput("holds no samples", place, "record or export the sound again");
  }
  return {};
}

float peakOf(const std::vector<float>& values) {
  float peak = 0;
  for (const float value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

std::vector<float> meanChannel(const std::vector<float>& values, std::size_t channels) {
  std::vector<float> mean(values.size() / channels);
  for (std::size_t i = 0; i < mean.size(); ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += static_cast<double>(values[i * channels + c]);
    mean[i] = static_cast<float>(sum / static_cast<double>(channels));
  }
  return mean;
}

/// Decision: channels of opposite sign (a swapped plug) would cancel; then the loudest one is used.
std::vector<float> downmix(const std::vector<float>& values, std::size_t channels) {
  std::vector<float> mean = meanChannel(values, channels);
  const float peak = peakOf(values);
  if (peakOf(mean) >= 0.1F * peak) return mean;
  const auto loudest = std::find_if(values.begin(), values.end(),
                                    [&](float value) { return std::abs(value) >= peak; });
  const std::size_t channel = static_cast<std::size_t>(loudest - values.begin()) % channels;
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = values[i * channels + channel];
  return mean;
}

}  // namespace

Result<Sound> readSound(const std::filesystem::path& path, const SoundLimits& limits) {
  const std::string place = path.string();
  if (auto good = checkPath(path); !good) return tl::unexpected<Error>(good.error());
  const QuietStderr quiet;
  SF_INFO info{};
  const File file(sf_open(path.c_str(), SFM_READ, &info), &sf_close);
  if (!file) {
    return badInput("is not a sound that can be read: " + reasonOf(nullptr), place, kConvert);
  }
  if (auto good = checkHeader(info, limits, place); !good) {
    return tl::unexpected<Error>(good.error());
  }
  Sound sound;
  sound.rate = info.samplerate;
  sound.channels = info.channels;
  sound.format = formatOf(info.format);
  std::vector<float> values;
  makeRoom(info, path, values);
  if (auto good = decode(file.get(), sound, limits, place, values); !good) {
    return tl::unexpected<Error>(good.error());
  }
  if (static_cast<double>(peakOf(values)) < limits.silentPeak) {
    return badInput(
        fmt::format("is silent: no sample reaches {:g} of full scale", limits.silentPeak), place,
        "record it louder, or amplify it");
  }
  if (sound.channels == 1) {
    sound.samples = std::move(values);
  } else {
    sound.samples = downmix(values, static_cast<std::size_t>(sound.channels));
    sound.interleaved = std::move(values);
  }
  return sound;
}

}  // namespace ifa
