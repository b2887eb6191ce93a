// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/film_settings.h"

#include <cmath>
#include <string>

extern "C" {
#include <libavutil/mathematics.h>
#include <libavutil/rational.h>
}

namespace ifa {

namespace {

constexpr int kMinSide = 16, kMaxSide = 8192;                         // pixels
constexpr double kMinFramesPerSecond = 1, kMaxFramesPerSecond = 240;  // Hz
constexpr double kMaxQuality = 51;
constexpr double kMinSpeed = 0.01, kMaxSpeed = 100;
constexpr int kMaxTerm = 1000000;  // of a frame rate

tl::unexpected<Error> badField(const char* field, const std::string& message) {
  return tl::unexpected<Error>(
      Error{ErrorCode::kUsage, message, field, "give a value in that range"});
}

Result<void> checkSide(const char* field, int side) {
  if (side >= kMinSide && side <= kMaxSide && side % 2 == 0) return {};
  return badField(field, std::to_string(side) + " is not an even number of pixels from " +
                             std::to_string(kMinSide) + " to " + std::to_string(kMaxSide));
}

// Not a number is out of every range.
Result<void> checkRange(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return badField(field, std::to_string(value) + " is not between " + std::to_string(low) +
                             " and " + std::to_string(high));
}

Result<void> checkSound(const Sound* sound) {
  if (sound == nullptr || (!sound->samples.empty() && sound->rate > 0)) return {};
  return tl::unexpected<Error>(Error{ErrorCode::kUsage, "has no samples or no rate", "sound",
                                     "give none for a film without sound"});
}

}  // namespace

Result<void> checkFilmSettings(const FilmSettings& settings, const Sound* sound) {
  if (auto good = checkSide("width", settings.width); !good) return good;
  if (auto good = checkSide("height", settings.height); !good) return good;
  if (auto good = checkRange("framesPerSecond", settings.framesPerSecond, kMinFramesPerSecond,
                             kMaxFramesPerSecond);
      !good) {
    return good;
  }
  if (auto good = checkRange("quality", settings.quality, 0, kMaxQuality); !good) return good;
  if (auto good = checkRange("speed", settings.speed, kMinSpeed, kMaxSpeed); !good) return good;
  return checkSound(sound);
}

FrameRate exactFrameRate(double framesPerSecond) {
  // 23.976 is a millionth below 24000/1001.
  const double whole = std::round(framesPerSecond * 1.001);
  if (std::abs(framesPerSecond * 1.001 / whole - 1) < 2e-6) {
    return {static_cast<int>(whole) * 1000, 1001};
  }
  const AVRational nearest = av_d2q(framesPerSecond, kMaxTerm);
  return {nearest.num, nearest.den};
}

std::int64_t samplesOfFrames(std::int64_t frames, FrameRate rate, int sampleRate) {
  const std::int64_t samplesTimesRate = static_cast<std::int64_t>(sampleRate) * rate.seconds;
  return av_rescale_rnd(frames, samplesTimesRate, rate.frames, AV_ROUND_DOWN);
}

}  // namespace ifa
#endif
