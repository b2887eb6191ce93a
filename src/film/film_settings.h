// SPDX-License-Identifier: Apache-2.0
// Settings of a film: whether they make sense, and what they mean exactly.
#pragma once

#include <cstdint>

#include "film/film_writer.h"

namespace ifa {

/// Frames a second as a fraction: `frames` in `seconds`.
struct FrameRate {
  int frames = 60, seconds = 1;
};

/// Errors: kUsage, the field is the place.
[[nodiscard]] Result<void> checkFilmSettings(const FilmSettings& settings, const Sound* sound);

/// The rates of television, which are written 23.976, 29.97, 59.94 and mean n * 1000/1001, exactly;
/// others as the nearest fraction of terms up to a million.
[[nodiscard]] FrameRate exactFrameRate(double framesPerSecond);

/// Samples of a sound that lasts as long as `frames` frames, a started one not counted.
[[nodiscard]] std::int64_t samplesOfFrames(std::int64_t frames, FrameRate rate, int sampleRate);

}  // namespace ifa
