// SPDX-License-Identifier: Apache-2.0
// The MP4 file that encoded pictures and sound go into.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "film/libav.h"
#include "film/temporary_file.h"

namespace ifa {

/// Tracks first, then `start`, then packets. Not thread safe.
class Muxer {
 public:
  /// Errors: kBadInput when the file cannot be made.
  [[nodiscard]] static Result<std::unique_ptr<Muxer>> open(const std::filesystem::path& path);

  /// @param encoder   open
  /// @param timeBase  unit in s of the time stamps of its packets
  /// @return the track's number
  [[nodiscard]] Result<int> addTrack(const AVCodecContext& encoder, AVRational timeBase);
  /// Writes the head. @param timescale  units a second in which the film's length is told
  [[nodiscard]] Result<void> start(int timescale);
  /// Has `frame` encoded and writes what comes of it; without a frame all that the encoder holds
  /// back. Errors: kBadInput when the disk is full; kInternal.
  [[nodiscard]] Result<void> encode(AVCodecContext& encoder, const AVFrame* frame, int track);
  /// Completes the file, with its table of contents in front, and gives it its name.
  [[nodiscard]] Result<void> finish();
  /// Nothing is left of the file.
  void discard() { file_.discard(); }

 private:
  Muxer() = default;
  [[nodiscard]] Result<void> writePacket(const AVCodecContext& encoder, int track);
  [[nodiscard]] tl::unexpected<Error> failure(const char* what, int code) const;

  // In this order: the format writes into io_, which writes into file_.
  TemporaryFile file_;
  LibavPtr<AVIOContext> io_;
  LibavPtr<AVFormatContext> format_;
  LibavPtr<AVPacket> packet_;
  std::vector<AVRational> timeBases_;  // of each track's packets
};

}  // namespace ifa
