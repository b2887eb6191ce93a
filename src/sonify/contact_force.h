// SPDX-License-Identifier: Apache-2.0
// The force of a blow over time.
#pragma once

#include <cstddef>
#include <vector>

#include "body/body.h"
#include "sonify/sound_material.h"
#include "sonify/strike.h"

namespace ifa {

/// A half sine, as mean force over each sample.
struct ForcePulse {
  std::size_t first = 0;      ///< sample
  std::vector<double> force;  ///< N
};

/// Time for which a blow lasts, s: that of a sphere as light as the body is at the struck point,
/// of a tenth of its size, that hits the floor (Hertz 1882).
[[nodiscard]] double contactTime(const Body& body, const Strike& strike,
                                 const SoundMaterial& material, const SoundMaterial& floor);

/// The blow that begins at `start` (s, >= 0) and lasts for `length` (s).
[[nodiscard]] ForcePulse forcePulse(double impulse, double start, double length, int rate);

}  // namespace ifa
