// SPDX-License-Identifier: Apache-2.0
// How a finish reflects: a GGX lobe (Walter et al. 2007) sampled by its visible normals (Heitz
// 2018).
#pragma once

#include <algorithm>

#include "render/body_geometry.h"

namespace ifa::render {

/// The lobe of one place for one direction of view.
class FinishLobe {
 public:
  /// @param normal, view  unit vectors, world frame, on the same side
  FinishLobe(const Finish& finish, const Vector& normal, const Vector& view)
      : finish_(finish),
        frame_(normal),
        view_(view.dot(frame_.tangent), view.dot(frame_.bitangent),
              std::max(view.dot(normal), 0.02f)) {}

  [[nodiscard]] const Frame& frame() const { return frame_; }

  /// Reflected radiance per radiance from `light`, without the cosine.
  [[nodiscard]] Colour reflectance(const Vector& light) const {
    const Vector l = local(light);
    if (l.z() <= 0) return Colour::Zero();
    const Vector half = (l + view_).normalized();
    return fresnel(half) *
           (distribution(half) * shadowing(view_) * shadowing(l) / (4 * view_.z() * l.z()));
  }
  /// Density of `sample` per unit of solid angle.
  [[nodiscard]] float density(const Vector& light) const {
    const Vector l = local(light);
    if (l.z() <= 0) return 0;
    return distribution((l + view_).normalized()) * shadowing(view_) / (4 * view_.z());
  }
  /// A direction by the lobe, for an even point of the unit disc.
  /// @param weight  set to reflectance times cosine over density
  [[nodiscard]] Vector sample(float x, float y, Colour& weight) const {
    const float a = finish_.alpha;
    const Frame stretched(Vector(a * view_.x(), a * view_.y(), view_.z()).normalized());
    const float lifted = 0.5f * (1 + stretched.normal.z());
    // Half of the disc is seen from the side: Heitz's warp, in a frame whose first axis is level.
    const float level = std::hypot(stretched.normal.x(), stretched.normal.y());
    const Vector first =
        level > 1e-6f ? Vector(-stretched.normal.y() / level, stretched.normal.x() / level, 0)
                      : Vector(Vector::UnitX());
    const Vector second = stretched.normal.cross(first);
    y = (1 - lifted) * std::sqrt(std::max(0.0f, 1 - x * x)) + lifted * y;
    const float z = std::sqrt(std::max(0.0f, 1 - x * x - y * y));
    const Vector n = x * first + y * second + z * stretched.normal;
    const Vector half = Vector(a * n.x(), a * n.y(), std::max(1e-6f, n.z())).normalized();
    const Vector l = 2 * half.dot(view_) * half - view_;
    weight = l.z() > 0 ? Colour(fresnel(half) * shadowing(l)) : Colour(Colour::Zero());
    return frame_.toWorld(l.x(), l.y(), l.z());
  }

 private:
  [[nodiscard]] Vector local(const Vector& d) const {
    return {d.dot(frame_.tangent), d.dot(frame_.bitangent), d.dot(frame_.normal)};
  }
  [[nodiscard]] Colour fresnel(const Vector& half) const {
    const Colour facing = finish_.facing();
    return facing + (1 - facing) * schlick(half.dot(view_));
  }
  [[nodiscard]] float distribution(const Vector& half) const {
    const float square = finish_.alpha * finish_.alpha;
    const float c = half.z() * half.z() * (square - 1) + 1;
    return square / (kPi * c * c);
  }
  [[nodiscard]] float shadowing(const Vector& d) const {
    const float square = finish_.alpha * finish_.alpha;
    const float level = (d.x() * d.x() + d.y() * d.y()) / std::max(d.z() * d.z(), 1e-8f);
    return 2 / (1 + std::sqrt(1 + square * level));
  }

  const Finish& finish_;
  Frame frame_;
  Vector view_;
};

}  // namespace ifa::render
