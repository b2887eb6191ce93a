// SPDX-License-Identifier: Apache-2.0
// The camera: where it stands, what it frames, how it moves.
#pragma once

#include <vector>

#include "ifa/film.h"
#include "render/moment.h"

namespace ifa::render {

/// A pinhole camera; no roll.
struct Camera {
  Vector eye = Vector::Zero(), right = Vector::UnitX(), up = Vector::UnitZ(),
         forward = Vector::UnitY();
  float halfHeight = 0.2f;  ///< tangent of half the vertical angle of view
  int width = 1, height = 1;

  /// Ray through a place in the picture, in pixels from its upper left corner.
  [[nodiscard]] Ray through(float x, float y) const;
  /// Where a point is seen, in pixels; z is its distance along the axis of view, m.
  [[nodiscard]] Vector project(const Vector& point) const;
  /// Width of a pixel at `distance` along the axis of view, m.
  [[nodiscard]] float pixelAt(float distance) const {
    return 2 * halfHeight * distance / static_cast<float>(height);
  }
  [[nodiscard]] bool operator==(const Camera& other) const;
};

/// What is left free at the edges of the picture.
struct FrameMargins {
  float side = 0.08f, top = 0.08f, bottom = 0.1f;  ///< shares of width and height
};

/// The camera over time. Bodies are framed from shortly before their first contact to the end; what
/// they do earlier may lie outside of the picture.
class CameraPath {
 public:
  CameraPath(CameraKind kind, const std::vector<Actor>& actors, int width, int height,
             const FrameMargins& margins);

  [[nodiscard]] Camera at(double time) const;
  [[nodiscard]] bool isFixed() const { return knots_.size() == 1; }
  /// Direction in which it looks, rad from the x axis, the same at all times.
  [[nodiscard]] float azimuth() const { return azimuth_; }
  /// Middle of what it frames, on the floor, and how far that reaches, m.
  [[nodiscard]] const Vector& middle() const { return middle_; }
  [[nodiscard]] float extent() const { return extent_; }

 private:
  struct Knot {
    Vector target = Vector::Zero();
    float distance = 1;
  };
  struct Ball {
    Vector centre;
    float radius;
    double time;
  };

  void gather(const std::vector<Actor>& actors);
  void chooseAzimuth(const std::vector<Actor>& actors);
  [[nodiscard]] Knot frame(double from, double to, const FrameMargins& margins) const;
  void follow(CameraKind kind, const FrameMargins& margins);
  void smooth(double deviation);
  void keepInView(const FrameMargins& margins);
  [[nodiscard]] Camera cameraOf(const Knot& knot) const;

  const bool isLow_;
  float elevation_;  ///< rad above the floor, seen from what is framed; negative: it looks up
  int width_, height_;
  float azimuth_ = 0, extent_ = 0.1f, leastDistance_ = 0.1f;
  float largest_ = 0;  ///< radius of the largest body, m
  Vector middle_ = Vector::Zero();
  std::vector<Ball> balls_;
  std::vector<Knot> knots_;
  double firstKnot_ = 0;
};

}  // namespace ifa::render
