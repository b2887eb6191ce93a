// SPDX-License-Identifier: Apache-2.0
// Pictures into a film's video track.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "film/film_settings.h"
#include "film/libav.h"
#include "film/muxer.h"
#include "model/image.h"

namespace ifa {

/// Encodes in the calling thread, so that the same frames give the same bytes. Not thread safe.
class VideoStream {
 public:
  /// The first of the settings' encoders that there is and that takes our pictures.
  /// Errors: kInternal when there is none.
  [[nodiscard]] static Result<VideoStream> open(const FilmSettings& settings, FrameRate rate,
                                                Muxer& muxer);

  /// @param frame  of the settings' size, or kInternal
  [[nodiscard]] Result<void> add(const Image& frame, Muxer& muxer);
  /// What the encoder still holds.
  [[nodiscard]] Result<void> finish(Muxer& muxer);

  [[nodiscard]] std::int64_t frames() const { return frames_; }
  /// Empty when the film is H.264.
  [[nodiscard]] const std::string& warning() const { return warning_; }

 private:
  VideoStream() = default;
  [[nodiscard]] Result<void> makeConverter();

  LibavPtr<AVCodecContext> encoder_;
  LibavPtr<SwsContext> converter_;
  LibavPtr<AVFrame> rgb_, yuv_;
  int track_ = 0;
  std::int64_t frames_ = 0;
  std::string warning_;
};

}  // namespace ifa
