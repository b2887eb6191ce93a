// SPDX-License-Identifier: Apache-2.0
// The floor as it is seen: its texture under the light that bodies leave it.
#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/floor_light.h"
#include "render/floor_texture.h"
#include "render/studio.h"

namespace ifa::render {

/// What a pixel shows of the floor, before light; or that it looks above it.
struct FloorPoint {
  Colour albedo = Colour::Zero();
  float x = 0, y = 0;  ///< m
  float pool = 1;      ///< share of the light that falls this far from the middle
  float mirrored = 0;  ///< share of the sky that the floor reflects towards the eye
  bool above = false;  ///< no floor is seen, but the backdrop above the horizon
};

/// Immutable, so that any number of threads may use it.
class FloorView {
 public:
  /// @param surface  see FloorTexture
  FloorView(const std::string& surface, const CameraPath& path);

  [[nodiscard]] FloorPoint point(const Camera& camera, int x, int y) const;
  /// The points of all pixels, row by row.
  [[nodiscard]] std::vector<FloorPoint> layer(const Camera& camera) const;
  /// Radiance towards the eye.
  /// @param view  direction from the eye
  [[nodiscard]] Colour lit(const FloorPoint& point, const Vector& view,
                           const std::vector<FloorLight>& lights) const;
  /// Radiance of the floor where a ray that goes down meets it.
  /// @param blur  m, width over which its texture is averaged
  [[nodiscard]] Colour seenFrom(const Ray& ray, float blur,
                                const std::vector<FloorLight>& lights) const;
  /// Share of the light that falls at a place.
  [[nodiscard]] float pool(float x, float y) const;
  [[nodiscard]] const Studio& studio() const { return studio_; }
  [[nodiscard]] float gloss() const { return texture_.gloss(); }

 private:
  [[nodiscard]] Eigen::Vector2f alongGrain(const Eigen::Vector2f& v) const;

  FloorTexture texture_;
  Studio studio_;
  Vector middle_;
  float extent_;
  Eigen::Vector2f grain_;  ///< unit vector along the grain
};

}  // namespace ifa::render
