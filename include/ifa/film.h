// SPDX-License-Identifier: Apache-2.0
// Motions as films: pictures with their sound.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifa/progress.h"
#include "ifa/result.h"

namespace ifa {

/// How the camera moves.
enum class CameraKind {
  kAuto,     ///< stands still where the object is large enough so; else it goes along, slowly
  kFixed,    ///< stands still and frames the whole motion
  kFollow,   ///< goes with the object
  kCloseUp,  ///< the same from nearby
  kLow,      ///< stands still with its eye at the floor, which is seen edge-on: heights are plain
};

/// What a film looks like. The defaults are those of `ifa render`.
struct FilmOptions {
  bool final = false;         ///< clean pictures that take longer; else a draft
  int width = 0, height = 0;  ///< pixels, even, 64 to 4096; 0: 640 x 360, or 1280 x 720 when final
  double framesPerSecond = 60;  ///< 1 to 240
  double shutter = 0.5;  ///< share of a frame's time that the shutter is open, 0 (no blur) to 1
  double speed = 1;  ///< 0.01 to 4; below 1 is slow motion, and the sound is stretched as a tape
  bool mute = false;
  std::optional<CameraKind> camera;  ///< none: automatic; for contact sheets from nearby
  bool overlay = false;              ///< waveform, playhead and contacts at the lower edge
  bool sideBySide = false;           ///< a picture for each motion; else all bodies share one floor
  std::string floor;  ///< desk, wood or carpet; empty: what the first motion's surface is
};

/// False in a build without libav: films cannot be written, everything else can.
[[nodiscard]] bool filmsCanBeWritten();

/// Renders motions as `output` says: NAME.mp4 a film, NAME.png a contact sheet (one picture a
/// contact, with its time), any other name a folder of numbered PNG files with the sound beside
/// them. Motions start together at their first contacts; the first one's sound is heard.
/// @param motions  motion.json files or the folders that hold them, with the object beside them
/// @param still    a time of the sound, s: one picture of that time, for NAME.png only
/// @return what the user should know, such as that the sound is missing; mostly empty
/// Errors: kUsage for options out of range; kBadInput for a motion that cannot be read or shown, or
/// an output that cannot be written; kInterrupted, and then nothing is written.
[[nodiscard]] Result<std::vector<std::string>> renderMotions(
    const std::vector<std::filesystem::path>& motions, const std::filesystem::path& output,
    const FilmOptions& options, std::optional<double> still = {}, const Progress& progress = {});

}  // namespace ifa
