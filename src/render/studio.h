// SPDX-License-Identifier: Apache-2.0
// The light: a square key light, so large and far that it is the same everywhere, and a sky.
#pragma once

#include <array>

#include "render/optics.h"

namespace ifa::render {

/// Unitless radiance; a white, diffuse, horizontal surface in full light shows about 1.
class Studio {
 public:
  /// @param azimuth  rad; the direction in which the camera looks, from the x axis. The key light
  ///                 stands on the camera's left.
  /// @param floorAlbedo  mean colour of the floor, which lights bodies from below
  Studio(float azimuth, const Colour& floorAlbedo);

  /// Radiance from direction `d` without the key light, as if there were no floor.
  [[nodiscard]] Colour sky(const Vector& d) const;
  /// The same without the lamps that are seen in shiny things, for what blurs them away.
  [[nodiscard]] Colour softSky(const Vector& d) const;
  /// The key light's radiance from direction `d`: a square with a soft rim, zero outside.
  [[nodiscard]] Colour key(const Vector& d) const;
  /// Direction to a point of the key light, even over its square and rim; u, v in [0, 1).
  [[nodiscard]] Vector towardsKey(float u, float v) const;
  /// Density of towardsKey per unit of solid angle, zero outside.
  [[nodiscard]] float keyDensity(const Vector& d) const;
  [[nodiscard]] const Vector& keyDirection() const { return keyFrame_.normal; }
  /// Largest angle of the key light from its middle, rad.
  [[nodiscard]] float keyAngle() const;
  /// Irradiance of a horizontal surface by the unshadowed key light.
  [[nodiscard]] const Colour& keyOnFloor() const { return keyOnFloor_; }
  [[nodiscard]] const Colour& skyOnFloor() const { return skyOnFloor_; }
  /// What the unshadowed floor sends upwards everywhere.
  [[nodiscard]] const Colour& floorRadiance() const { return floorRadiance_; }
  /// Irradiance by sky and unshadowed floor of a surface with this normal.
  [[nodiscard]] Colour ambient(const Vector& normal) const;
  /// Irradiance by the unshadowed key light, its middle standing for all of it.
  [[nodiscard]] Colour keyIrradiance(const Vector& normal) const;

 private:
  void integrate();

  Frame keyFrame_{Vector::UnitZ()};
  Vector right_, forward_;
  Colour keyOnFloor_, skyOnFloor_, floorRadiance_, floorAlbedo_;
  std::array<Colour, 9> harmonics_;  ///< of the irradiance (Ramamoorthi and Hanrahan 2001)
};

}  // namespace ifa::render
