// SPDX-License-Identifier: Apache-2.0
// A sound at another rate and speed, piece by piece.
#pragma once

#include <cstddef>
#include <vector>

#include "film/libav.h"
#include "sound/sound.h"

namespace ifa {

/// The sound as a tape at `speed` plays it, then silence without end. Sample 0 stays sample 0, and
/// over an hour the drift is below 0.1 ms. Not thread safe.
class StretchedSound {
 public:
  /// @param sound  with samples; must live as long as this
  /// @param speed  > 0; 0.25 lasts four times as long, two octaves lower
  /// @param rate   samples a second of what comes out
  [[nodiscard]] static Result<StretchedSound> open(const Sound& sound, double speed, int rate);

  /// 2 for a stereo sound, otherwise 1.
  [[nodiscard]] int channels() const { return channels_; }
  /// The next `count` samples of each channel into `planes[channel]`.
  [[nodiscard]] Result<void> read(float* const* planes, std::size_t count);

 private:
  StretchedSound() = default;
  [[nodiscard]] Result<void> convertMore();

  LibavPtr<SwrContext> resampler_;
  const std::vector<float>* source_ = nullptr;  // interleaved
  int channels_ = 1;
  std::size_t next_ = 0;                     // value of source_ to be converted
  std::vector<std::vector<float>> pending_;  // converted, of each channel
};

}  // namespace ifa
