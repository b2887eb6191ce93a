// SPDX-License-Identifier: Apache-2.0
// A sound into a film's audio track.
#pragma once

#include <cstdint>

#include "film/libav.h"
#include "film/muxer.h"
#include "film/stretched_sound.h"

namespace ifa {

/// AAC at 48 kHz, mono or stereo. What the encoder puts before the first sample is told to the file
/// as an edit list, so that players begin with the sound's sample 0. Not thread safe.
class AudioStream {
 public:
  static constexpr int kRate = 48000;  ///< samples a second

  /// @param sound  with samples; must live as long as this. Errors: kInternal.
  [[nodiscard]] static Result<AudioStream> open(const Sound& sound, double speed, Muxer& muxer);

  /// Encodes whole blocks that end at or before sample `end`.
  [[nodiscard]] Result<void> encodeUntil(std::int64_t end, Muxer& muxer);
  /// Encodes the rest, so that the track ends at sample `end`.
  [[nodiscard]] Result<void> finish(std::int64_t end, Muxer& muxer);

 private:
  explicit AudioStream(StretchedSound source) : source_(std::move(source)) {}
  [[nodiscard]] Result<void> encodeBlock(int count, Muxer& muxer);

  StretchedSound source_;
  LibavPtr<AVCodecContext> encoder_;
  int track_ = 0;
  std::int64_t next_ = 0;  // sample to be encoded
};

}  // namespace ifa
