// SPDX-License-Identifier: Apache-2.0
// A picture of bodies on a floor at one time of their motion.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "model/image.h"
#include "render/camera.h"
#include "render/floor_light.h"
#include "render/floor_texture.h"
#include "render/moment.h"
#include "render/studio.h"
#include "render/tone.h"

namespace ifa::render {

/// What a picture costs and how clean it is.
struct RenderSettings {
  int width = 640, height = 360;  ///< pixels
  int samplesPerPixel = 8;        ///< of bodies, a power of two
  FloorLightSettings floorLight;  ///< `pixel` is set by the renderer
  CameraKind camera = CameraKind::kAuto;
  FrameMargins margins;
  double shutterSeconds = 1.0 / 120;  ///< how long the shutter is open, in the motion's time
  std::string surface = "desk";       ///< see FloorTexture
};

/// Draws bodies in a studio. The floor is a plane whose light is known without rays; only what a
/// body covers, shades or is mirrored in is traced, and a camera that stands still draws the rest
/// of the floor once.
class FrameRenderer {
 public:
  FrameRenderer(std::vector<Actor> actors, const RenderSettings& settings);

  /// The picture with the shutter's opening centred at `time` (s of the stage). Thread safe, and
  /// the same whatever is drawn beside it.
  [[nodiscard]] Image render(double time) const;
  /// True when the pictures at both times are surely the same.
  [[nodiscard]] bool sameAt(double time, double other) const;
  [[nodiscard]] const CameraPath& cameraPath() const { return path_; }
  /// Rays traced so far, by all threads.
  [[nodiscard]] long rays() const { return rays_.load(); }

 private:
  struct FloorPoint {
    Colour albedo;
    float x = 0, y = 0;
    float pool = 1;      ///< share of the light that falls this far from the middle
    float mirrored = 0;  ///< share of the sky that the floor reflects towards the eye
  };
  struct Picture;  // one frame in the making

  [[nodiscard]] float pool(float x, float y) const;
  [[nodiscard]] FloorPoint floorPoint(const Camera& camera, int x, int y) const;
  [[nodiscard]] std::vector<FloorPoint> floorLayer(const Camera& camera) const;
  [[nodiscard]] Colour litFloor(const Picture& picture, const FloorPoint& point,
                                const Vector& view) const;
  [[nodiscard]] Colour floorSeenFrom(const Picture& picture, const Ray& ray, float blur) const;
  [[nodiscard]] Colour mirroredInFloor(const Picture& picture, const FloorPoint& point,
                                       const Vector& view, int x, int y) const;
  [[nodiscard]] Colour around(const Picture& picture, const Ray& ray, const Sample& sample,
                              std::size_t except, float blur, bool sharp) const;
  [[nodiscard]] Colour shade(const Picture& picture, const Ray& ray, const SurfaceHit& hit,
                             const Sample& sample, std::size_t self) const;
  [[nodiscard]] Colour pixel(const Picture& picture, const FloorPoint& point, int x, int y) const;
  void draw(Picture& picture, const std::vector<FloorPoint>& layer) const;
  void light(Picture& picture) const;
  void put(Image& image, int x, int y, const Colour& tonedColour) const;

  std::vector<Actor> actors_;
  RenderSettings settings_;
  SampleTable samples_;
  FloorTexture texture_;
  CameraPath path_;
  Studio studio_;
  ScreenCurve curve_;
  std::vector<FloorPoint> stillFloor_;  ///< of a camera that stands still
  Image stillImage_;
  mutable std::atomic<long> rays_{0};
};

}  // namespace ifa::render
