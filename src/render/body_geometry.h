// SPDX-License-Identifier: Apache-2.0
// A body's triangles behind Embree: where a ray meets them, with colour and normal.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "body/body.h"
#include "render/optics.h"

namespace ifa::render {

/// How a surface answers light.
struct Finish {
  Colour colour = Colour(0.8f, 0.8f, 0.8f);
  float alpha = 0.3f;  ///< width of the GGX lobe: the square of roughness
  float metallic = 0;  ///< 0 or 1, or between
  /// Share of light that is reflected head on.
  [[nodiscard]] Colour facing() const { return 0.04f + metallic * (colour - 0.04f); }
  [[nodiscard]] Colour diffuse() const { return colour * (1 - metallic); }
};

/// Where a ray meets a body, in the frame of whoever asked.
struct SurfaceHit {
  float distance = 0;
  Vector normal;     ///< for shading: smooth where the mesh is
  Vector geometric;  ///< of the triangle; both towards where the ray came from
  const Finish* finish = nullptr;
  bool open = false;  ///< the whole body lies behind the triangle: it cannot shade this place
};

/// Immutable, so that any number of threads may trace it.
class BodyGeometry {
 public:
  explicit BodyGeometry(const Body& body);
  ~BodyGeometry();
  BodyGeometry(BodyGeometry&&) noexcept;
  BodyGeometry& operator=(BodyGeometry&&) = delete;

  /// Nearest hit closer than `limit`, in the body frame. False when there is none.
  bool intersect(const Ray& ray, float limit, SurfaceHit& hit) const;
  [[nodiscard]] bool occludes(const Ray& ray) const;
  /// Distance of the nearest hit, or infinity.
  [[nodiscard]] float distance(const Ray& ray) const;
  /// Distance of the furthest vertex from the centre of mass, m.
  [[nodiscard]] float radius() const { return radius_; }

 private:
  struct Device;
  std::unique_ptr<Device> device_;
  std::vector<std::array<float, 3>> normals_;
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<std::uint8_t> finishOf_, isOpen_;  ///< per triangle
  std::vector<Finish> finishes_;
  float radius_ = 0;
};

}  // namespace ifa::render
