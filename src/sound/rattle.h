// SPDX-License-Identifier: Apache-2.0
// Which rises of a sound are one contact that lasts: a rattle, a roll, a spin-down.
#pragma once

#include <vector>

#include "sound/onset_detector.h"

namespace ifa {

/// What the small rises of a sound say of its contacts. A rattle is made of `rattleFill` of them at
/// least: fewer are soft contacts.
class Rattles {
 public:
  /// @param smallRises  their times, s, in order
  Rattles(std::vector<double> smallRises, const DetectorSettings& settings);

  /// End of what rattles on after a contact at `start`, before `next`; `start` if nothing does.
  [[nodiscard]] double endOf(double start, double next) const;

  /// Makes the last contacts one with what goes on between and after them, from the end back.
  void joinLast(std::vector<DetectedContact>& contacts) const;

 private:
  /// The last of the small rises that follow each other without a pause.
  [[nodiscard]] double lastOf(double start, double next) const;
  /// Whether the object keeps to the surface between two contacts: small rises as dense as the
  /// merge filter's gap, or some of them and never a flight between.
  [[nodiscard]] bool join(double first, double second) const;
  /// Small rises in (from, to].
  [[nodiscard]] int countIn(double from, double to) const;

  std::vector<double> smallRises_;
  DetectorSettings settings_;
};

}  // namespace ifa
