// SPDX-License-Identifier: Apache-2.0
// Frames and a sound into an MP4 file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ifa/film.h"  // filmsCanBeWritten()
#include "ifa/result.h"
#include "model/image.h"
#include "sound/sound.h"

namespace ifa {

/// How a film is encoded.
struct FilmSettings {
  int width = 640, height = 360;  ///< pixels, even, 16 to 8192
  /// 1 to 240. 23.976, 29.97, 59.94 and the like mean n * 1000/1001 exactly.
  double framesPerSecond = 60;
  double quality = 20;  ///< constant rate factor of H.264, 0 (lossless) to 51
  /// 0.01 to 100: the sound is stretched to 1/speed of its length, as a tape is.
  double speed = 1;
  /// Names of libav's video encoders: the first that there is, that takes 4:2:0 pictures and opens.
  std::vector<std::string> encoders = {"libx264", "libopenh264", "mpeg4"};
};

/// Writes a film frame by frame: MP4 with its table of contents in front, H.264 (BT.709) and AAC
/// (48 kHz, mono or stereo). Frame k is shown from k/framesPerSecond s on; the sound's first sample
/// is heard at 0 s exactly. The film is as long as its frames: a longer sound is cut, a shorter one
/// is followed by silence. The same frames and sound give the same bytes. Once a call has failed,
/// nothing is left of the file and every later call fails alike. Libav's log callback is replaced
/// for the whole process, so that libav prints nothing. One writer is not thread safe, several are
/// independent.
class FilmWriter {
 public:
  /// Writes to a temporary beside `path`, so nothing is seen under that name before `finish`.
  /// @param sound  with samples, or none for a film without an audio track; is read until `finish`.
  ///   Stereo stays stereo; of more channels the one of `samples` is heard.
  /// Errors: kUsage when a setting is out of its range, its name is the place; kBadInput when the
  /// file cannot be made; kInternal when no encoder can be used or libav refuses.
  [[nodiscard]] static Result<FilmWriter> open(const std::filesystem::path& path,
                                               const FilmSettings& settings, const Sound* sound);

  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) = delete;
  /// Leaves no trace unless finished.
  ~FilmWriter();

  /// @param frame  of the settings' size, or kInternal. Errors: kBadInput when the disk is full.
  [[nodiscard]] Result<void> add(const Image& frame);
  /// Completes the file and gives it its name. Errors: kInternal without a frame or when called
  /// again; kBadInput when the disk is full; an older file of that name then stays.
  [[nodiscard]] Result<void> finish();
  /// What the user should know: that the film is not H.264, and what it is. Mostly empty.
  [[nodiscard]] const std::string& warning() const;

 private:
  struct Encoder;
  explicit FilmWriter(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace ifa
