// SPDX-License-Identifier: Apache-2.0
// The light that a body sends towards the eye, straight or by way of the floor's varnish.
#pragma once

#include <vector>

#include "render/finish_lobe.h"
#include "render/floor_view.h"
#include "render/moment.h"

namespace ifa::render {

/// Everything that bodies and floor exchange light with in one frame.
struct Surroundings {
  const Moment& moment;
  const std::vector<FloorLight>& lights;  ///< one a body
};

/// Estimates radiance by one sample at a time. Immutable; `floor` must outlive it.
class BodyShader {
 public:
  explicit BodyShader(const FloorView& floor) : floor_(floor), studio_(floor.studio()) {}

  /// @param self  number of the body that the ray hits
  [[nodiscard]] Colour radiance(const Surroundings& surroundings, const Ray& ray,
                                const SurfaceHit& hit, const Sample& sample,
                                std::size_t self) const;
  /// What the floor's varnish shows of bodies at a point, instead of the sky.
  /// @param view  direction from the eye
  [[nodiscard]] Colour mirroredInFloor(const Surroundings& surroundings, const FloorPoint& point,
                                       const Vector& view, const Sample* samples, int count) const;

 private:
  /// A place on a body that is looked at.
  struct Place {
    Vector position;  ///< just off the surface
    const SurfaceHit& hit;
    const Finish& finish;
    FinishLobe lobe;
    Colour diffuse;      ///< reflectance of what is not mirrored
    std::size_t except;  ///< the body itself where it cannot shade the place, or kNobody
  };

  [[nodiscard]] Colour keyLight(const Surroundings& surroundings, const Place& place,
                                const Sample& sample) const;
  [[nodiscard]] Colour diffuseLight(const Surroundings& surroundings, const Place& place,
                                    const Sample& sample) const;
  [[nodiscard]] Colour mirroredLight(const Surroundings& surroundings, const Place& place,
                                     const Sample& sample, float radius) const;
  [[nodiscard]] Colour around(const Surroundings& surroundings, const Ray& ray,
                              const Sample& sample, std::size_t except, float blur,
                              bool sharp) const;

  const FloorView& floor_;
  const Studio& studio_;
};

}  // namespace ifa::render
