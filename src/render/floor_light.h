// SPDX-License-Identifier: Apache-2.0
// The light that a body takes from the floor, and gives back: shadow, ambient occlusion, bounce.
#pragma once

#include <vector>

#include "render/moment.h"
#include "render/studio.h"

namespace ifa::render {

/// A grid over part of the floor.
template <class T>
struct FloorGrid {
  float left = 0, low = 0, step = 1;  ///< m
  int columns = 0, rows = 0;
  std::vector<T> values;

  /// Bilinear; `outside` where the grid does not reach.
  [[nodiscard]] T at(float x, float y, const T& outside) const {
    const float u = (x - left) / step - 0.5f, v = (y - low) / step - 0.5f;
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(columns - 1) &&
          v < static_cast<float>(rows - 1))) {
      return outside;
    }
    const auto i = static_cast<std::size_t>(u), k = static_cast<std::size_t>(v);
    const float a = u - static_cast<float>(i), b = v - static_cast<float>(k);
    const T* from = values.data() + k * static_cast<std::size_t>(columns) + i;
    const T* above = from + columns;
    return (from[0] * (1 - a) + from[1] * a) * (1 - b) + (above[0] * (1 - a) + above[1] * a) * b;
  }
};

/// How finely the floor's light is looked at.
struct FloorLightSettings {
  int keyRays = 4, ambientRays = 8;  ///< per point, powers of two
  float keyFineness = 64;            ///< points per radius of the body at most
  float ambientFineness = 24;
  float pixel = 1e-3f;  ///< width of a pixel on the floor by the body, m
};

/// Irradiance of the floor near one body, averaged over the shutter's opening. Noise is removed by
/// a filter as wide as the light varies there, which the distances of what shades tell
/// (axis-aligned filtering: Mehta, Wang and Ramamoorthi 2012), so that shadows are sharp at a
/// contact only.
class FloorLight {
 public:
  FloorLight(const ActorMoment& actor, const Studio& studio, const SampleTable& samples,
             const FloorLightSettings& settings);

  /// Share of the key light that arrives.
  [[nodiscard]] float key(float x, float y) const { return key_.at(x, y, 1.0f); }
  /// What is added to the sky's irradiance; mostly negative.
  [[nodiscard]] Colour ambient(float x, float y) const {
    return ambient_.at(x, y, Colour(Colour::Zero()));
  }
  [[nodiscard]] const FloorGrid<float>& keyGrid() const { return key_; }
  [[nodiscard]] const FloorGrid<Colour>& ambientGrid() const { return ambient_; }

 private:
  void lightKey(const ActorMoment& actor, const Studio& studio, const SampleTable& samples,
                const FloorLightSettings& settings);
  void lightAmbient(const ActorMoment& actor, const Studio& studio, const SampleTable& samples,
                    const FloorLightSettings& settings);

  FloorGrid<float> key_;
  FloorGrid<Colour> ambient_;
};

/// Radiance of a body's surface by unshadowed light, for what is only seen in passing: reflections
/// and bounces.
[[nodiscard]] Colour roughRadiance(const SurfaceHit& hit, const Vector& towardsEye,
                                   const Studio& studio);

}  // namespace ifa::render
