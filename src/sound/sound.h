// SPDX-License-Identifier: Apache-2.0
// Sound files as samples: reading whatever libsndfile knows (WAV, FLAC, Ogg, MP3...), writing WAV.
#pragma once

#include <filesystem>
#include <vector>

#include "ifa/result.h"

namespace ifa {

/// How the samples of a WAV file are stored.
enum class SampleFormat { kPcm16, kPcm24, kFloat };

/// A recording in memory.
struct Sound {
  std::vector<float> samples;  ///< one channel, full scale at -1 and 1; what everything listens to
  int rate = 0;                ///< samples per second
  int channels = 1;            ///< of the file
  /// All channels, frame by frame, as the file has them; empty when `channels` is 1.
  std::vector<float> interleaved;
  SampleFormat format = SampleFormat::kPcm16;  ///< the smallest that keeps the file's samples

  /// Length in s.
  [[nodiscard]] double duration() const {
    return rate > 0 ? static_cast<double>(samples.size()) / rate : 0;
  }
};

/// What is refused, and from where on.
struct SoundLimits {
  double maxSeconds = 3600;
  double maxBytes = 2147483648.0;  ///< of samples in memory, over all channels
  int minRate = 1000;              ///< Hz; contacts are timed to the millisecond
  int maxRate = 1000000;           ///< Hz
  int maxChannels = 64;
  double silentPeak = 1e-4;  ///< a sound that never reaches this (-80 dB of full scale) is silence
};

/// Reads a sound file. The one channel is the mean of all; the loudest alone where the mean cancels
/// to less than a tenth of it (channels of opposite sign).
/// Errors: kBadInput, each with its own message: no such file, empty, not a sound, no samples, too
/// long, too many bytes, an impossible rate, a sample that is not a finite number (its index is
/// named), silence.
[[nodiscard]] Result<Sound> readSound(const std::filesystem::path& path,
                                      const SoundLimits& limits = {});

/// Writes `sound` as WAV with all its channels, in its own format, after `leadingSilence` seconds
/// (>= 0, rounded to whole samples) of silence. 16 and 24 bit samples come out as they went in.
/// Atomic: no half-written file is left. Errors: kBadInput when it cannot be written or would not
/// fit into a WAV file (4 GiB).
[[nodiscard]] Result<void> writeWav(const std::filesystem::path& path, const Sound& sound,
                                    double leadingSilence = 0);

}  // namespace ifa
