// SPDX-License-Identifier: Apache-2.0
#include "render/frame_renderer.h"

#include <algorithm>

#include "render/pixel_box.h"

namespace ifa::render {
namespace {

// Samples of a pixel that differ by less, as square roots, need no company: some 10 of 255 levels.
constexpr float kEven = 0.04f;
// What moves by fewer pixels while the shutter is open is drawn with half of the samples.
constexpr float kSharp = 2;

}  // namespace

/// One frame in the making.
struct FrameRenderer::Picture {
  Camera camera;
  Moment moment;
  std::vector<FloorLight> lights;  ///< one a body
  int samples = 1;                 ///< of a pixel
  PixelBox bodies, mirrored, shaded;
  Image image;
};

FrameRenderer::FrameRenderer(std::vector<Actor> actors, const RenderSettings& settings)
    : actors_(std::move(actors)),
      settings_(settings),
      samples_(std::max({settings.samplesPerPixel, settings.floorLight.keyRays,
                         settings.floorLight.ambientRays})),
      path_(settings.camera, actors_, settings.width, settings.height, settings.margins),
      floor_(settings.surface, path_),
      shader_(floor_) {
  if (!path_.isFixed()) return;
  const Camera camera = path_.at(0);
  stillFloor_ = floor_.layer(camera);
  Picture empty{camera, Moment({}, 0, 0), {}, 1, {}, {}, {}, Image(camera.width, camera.height)};
  empty.shaded = {0, 0, camera.width, camera.height};
  draw(empty, stillFloor_);
  stillImage_ = std::move(empty.image);
}

Colour FrameRenderer::pixel(const Picture& picture, const FloorPoint& point, int x, int y) const {
  const Ray middle =
      picture.camera.through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const Surroundings surroundings{picture.moment, picture.lights};
  const Sample* samples = samples_.at(x, y);
  Colour floor = floor_.lit(point, middle.direction, picture.lights);
  if (point.mirrored > 0 && picture.mirrored.holds(x, y)) {
    floor += shader_.mirroredInFloor(surroundings, point, middle.direction, samples,
                                     std::max(1, picture.samples / 2));
  }
  floor = toned(floor);
  if (!picture.bodies.holds(x, y)) return floor;
  Colour sum = Colour::Zero(), low = Colour::Ones(), high = sum;
  int hits = 0, taken = 0;
  SurfaceHit hit;
  while (taken < picture.samples) {
    const Sample& s = samples[taken++];
    const Ray ray =
        picture.camera.through(static_cast<float>(x) + s.x, static_cast<float>(y) + s.y);
    const std::size_t actor = picture.moment.intersect(ray, s.instant, s.choice, hit);
    Colour seen = floor;
    if (actor != Moment::kNobody) {
      seen = toned(shader_.radiance(surroundings, ray, hit, s, actor));
      ++hits;
    }
    sum += seen;
    low = low.min(seen);
    high = high.max(seen);
    // Most pixels are either all floor or all one face.
    const bool even =
        hits == taken ? 4 * taken >= picture.samples : hits == 0 && 2 * taken >= picture.samples;
    if (even && taken >= 4 && (high.sqrt() - low.sqrt() < kEven).all()) break;
  }
  return sum / static_cast<float>(taken);
}

void FrameRenderer::put(Image& image, int x, int y, const Colour& tonedColour) const {
  std::uint8_t* to =
      image.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  for (int k = 0; k < 3; ++k) to[k] = curve_(tonedColour[k]);
}

void FrameRenderer::light(Picture& picture) const {
  bool blurred = false;
  for (const ActorMoment& actor : picture.moment.actors()) {
    FloorLightSettings settings = settings_.floorLight;
    const Vector below(actor.centre().x(), actor.centre().y(), 0);
    settings.pixel = picture.camera.pixelAt(picture.camera.project(below).z());
    picture.lights.emplace_back(actor, floor_.studio(), samples_, settings);
    if (actor.presence() <= 0) continue;
    blurred = blurred || actor.sweep() > kSharp * settings.pixel || actor.presence() < 1;
    picture.bodies.includeBall(actor.centre(), actor.reach(), picture.camera);
    picture.mirrored.includeBall({actor.centre().x(), actor.centre().y(), -actor.centre().z()},
                                 1.5f * actor.reach(), picture.camera);
    picture.shaded.includeGrid(picture.lights.back().keyGrid(), picture.camera);
    picture.shaded.includeGrid(picture.lights.back().ambientGrid(), picture.camera);
  }
  picture.samples = blurred ? settings_.samplesPerPixel : (settings_.samplesPerPixel + 1) / 2;
  picture.shaded.include(picture.bodies);
  picture.shaded.include(picture.mirrored);
}

void FrameRenderer::draw(Picture& picture, const std::vector<FloorPoint>& layer) const {
  for (int y = picture.shaded.top; y < picture.shaded.bottom; ++y) {
    for (int x = picture.shaded.left; x < picture.shaded.right; ++x) {
      const auto index = static_cast<std::size_t>(y * picture.camera.width + x);
      put(picture.image, x, y, pixel(picture, layer[index], x, y));
    }
  }
}

Image FrameRenderer::render(double time) const {
  const long before = ActorMoment::raysOfThisThread();
  Picture picture{
      path_.at(time), Moment(actors_, time, settings_.shutterSeconds), {}, 1, {}, {}, {}, {}};
  light(picture);
  if (path_.isFixed()) {
    picture.image = stillImage_;
    draw(picture, stillFloor_);
  } else {
    picture.image = Image(picture.camera.width, picture.camera.height);
    picture.shaded = {0, 0, picture.camera.width, picture.camera.height};
    draw(picture, floor_.layer(picture.camera));
  }
  rays_ += ActorMoment::raysOfThisThread() - before;
  return std::move(picture.image);
}

bool FrameRenderer::sameAt(double time, double other) const {
  return path_.at(time) == path_.at(other) &&
         Moment(actors_, time, settings_.shutterSeconds)
             .sameAs(Moment(actors_, other, settings_.shutterSeconds));
}

}  // namespace ifa::render
