// SPDX-License-Identifier: Apache-2.0
// The strip at a film's lower edge: waveform, playhead, contacts that flash when they sound.
#pragma once

#include <string>
#include <vector>

#include "ifa/motion.h"
#include "model/image.h"
#include "sound/sound.h"

namespace ifa::render {

/// Drawn once for the whole film, then completed for each frame. Thread safe.
class Overlay {
 public:
  /// @param sound    without samples the waveform is left out
  /// @param seconds  of the sound's time that the strip spans
  /// @param speed    told beside the time when it is not 1
  /// @param step     between frames, s of the sound: a contact flashes in the frame nearest to it
  Overlay(const Motion& motion, const Sound& sound, double seconds, double speed, double step,
          int width, int height);

  /// @param time  of the sound, s
  void draw(Image& frame, double time) const;
  /// Share of the picture's height that the strip covers.
  static constexpr double kShare = 0.13;

 private:
  struct Mark {
    double start = 0, end = 0;  ///< s of the sound
    double level = 1;           ///< 0 to 1
  };

  [[nodiscard]] double place(double time) const { return width_ * time / seconds_; }

  int width_, top_, stripHeight_;
  double seconds_, speed_, step_;
  std::vector<float> low_, high_;
  std::vector<Mark> marks_;
};

}  // namespace ifa::render
