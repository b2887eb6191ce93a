// SPDX-License-Identifier: Apache-2.0
#include "render/frame_renderer.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"
#include "render/finish_lobe.h"

namespace ifa::render {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Of the sky's light at least this share arrives everywhere.
constexpr float kLeastSky = 0.04f;
// The floor's varnish loses this share of what a mirror would show.
constexpr float kVarnish = 0.55f;

// Samples of a pixel that differ by less, as square roots, need no company: some 10 of 255 levels.
constexpr float kEven = 0.04f;

// What moves by fewer pixels while the shutter is open is drawn with half of the samples.
constexpr float kSharp = 2;

/// A rectangle of pixels; `high` is one past the last.
struct PixelBox {
  int left = std::numeric_limits<int>::max(), top = std::numeric_limits<int>::max();
  int right = 0, bottom = 0;

  void include(float x, float y, float reach, const Camera& camera) {
    left = std::min(left, std::clamp(static_cast<int>(x - reach), 0, camera.width));
    top = std::min(top, std::clamp(static_cast<int>(y - reach), 0, camera.height));
    right = std::max(right, std::clamp(static_cast<int>(x + reach) + 1, 0, camera.width));
    bottom = std::max(bottom, std::clamp(static_cast<int>(y + reach) + 1, 0, camera.height));
  }
  /// @param factor  of the radius, 1 for the ball's outline itself
  void includeBall(const Vector& centre, float radius, const Camera& camera) {
    const Vector seen = camera.project(centre);
    // The outline of a ball off the axis is an ellipse; a tenth covers it at these angles.
    include(seen.x(), seen.y(),
            1.1f * radius / camera.pixelAt(std::max(seen.z() - radius, 1e-4f)) + 1, camera);
  }
  template <class T>
  void includeGrid(const FloorGrid<T>& grid, const Camera& camera) {
    if (grid.values.empty()) return;
    for (int corner = 0; corner < 4; ++corner) {
      const Vector place(grid.left + static_cast<float>(corner % 2 * grid.columns) * grid.step,
                         grid.low + static_cast<float>(corner / 2 * grid.rows) * grid.step, 0);
      const Vector seen = camera.project(place);
      include(seen.x(), seen.y(), 1, camera);
    }
  }
  void include(const PixelBox& other) {
    left = std::min(left, other.left), top = std::min(top, other.top);
    right = std::max(right, other.right), bottom = std::max(bottom, other.bottom);
  }
  [[nodiscard]] bool holds(int x, int y) const {
    return x >= left && x < right && y >= top && y < bottom;
  }
};

}  // namespace

/// One frame in the making.
struct FrameRenderer::Picture {
  Camera camera;
  Moment moment;
  std::vector<FloorLight> lights;  ///< one a body
  std::vector<float> pools;        ///< share of the light that falls where the body is
  int samples = 1;                 ///< of a pixel
  PixelBox bodies, mirrored, shaded;
  Image image;
};

FrameRenderer::FrameRenderer(std::vector<Actor> actors, const RenderSettings& settings)
    : actors_(std::move(actors)),
      settings_(settings),
      samples_(std::max({settings.samplesPerPixel, settings.floorLight.keyRays,
                         settings.floorLight.ambientRays})),
      texture_(settings.surface),
      path_(settings.camera, actors_, settings.width, settings.height, settings.margins),
      studio_(path_.azimuth(), texture_.mean()) {
  if (!path_.isFixed()) return;
  const Camera camera = path_.at(0);
  stillFloor_ = floorLayer(camera);
  Picture empty{
      camera, Moment({}, 0, 0), {}, {}, 1, {}, {}, {}, Image(camera.width, camera.height)};
  empty.shaded = {0, 0, camera.width, camera.height};
  draw(empty, stillFloor_);
  stillImage_ = std::move(empty.image);
}

// A pool of light around what happens: the eye stays there.
float FrameRenderer::pool(float x, float y) const {
  const float away = (Eigen::Vector2f(x, y) - path_.middle().head<2>()).squaredNorm() /
                     (path_.extent() * path_.extent());
  const float fall = 1 / (1 + 0.25f * away);
  return 0.42f + 0.58f * fall * fall;
}

FrameRenderer::FloorPoint FrameRenderer::floorPoint(const Camera& camera, int x, int y) const {
  const Ray ray = camera.through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const float distance = -ray.origin.z() / ray.direction.z();
  const Vector place = ray.origin + distance * ray.direction;
  const float across = camera.pixelAt(distance * ray.direction.dot(camera.forward));
  const Eigen::Vector2f along = across / -ray.direction.z() * ray.direction.head<2>().normalized();
  // The grain runs a little askew to the picture's edges.
  const float turn = path_.azimuth() - 0.5f * kPi - 0.16f;
  const float c = std::cos(turn), s = std::sin(turn);
  const auto turned = [&](const Eigen::Vector2f& v) {
    return Eigen::Vector2f(c * v.x() + s * v.y(), c * v.y() - s * v.x());
  };
  const Eigen::Vector2f uv = turned(place.head<2>());
  FloorPoint point;
  point.albedo = texture_.at(uv.x(), uv.y(), across, turned(along));
  point.x = place.x();
  point.y = place.y();
  point.pool = pool(place.x(), place.y());
  if (texture_.gloss() > 0) {
    point.mirrored = kVarnish * (0.04f + 0.96f * schlick(-ray.direction.z()));
  }
  return point;
}

std::vector<FrameRenderer::FloorPoint> FrameRenderer::floorLayer(const Camera& camera) const {
  std::vector<FloorPoint> layer(static_cast<std::size_t>(camera.width) *
                                static_cast<std::size_t>(camera.height));
  parallelFor(static_cast<std::size_t>(camera.height), [&](std::size_t row) {
    for (int x = 0; x < camera.width; ++x) {
      layer[row * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(x)] =
          floorPoint(camera, x, static_cast<int>(row));
    }
  });
  return layer;
}

Colour FrameRenderer::litFloor(const Picture& picture, const FloorPoint& point,
                               const Vector& view) const {
  float key = 1;
  Colour sky = studio_.skyOnFloor();
  for (const FloorLight& light : picture.lights) {
    key *= light.key(point.x, point.y);
    sky += light.ambient(point.x, point.y);
  }
  sky = sky.max(kLeastSky * studio_.skyOnFloor());
  const Vector mirror(view.x(), view.y(), -view.z());
  return point.pool * (point.albedo / kPi * (key * studio_.keyOnFloor() + sky) +
                       point.mirrored * studio_.softSky(mirror));
}

// What the varnish shows of bodies, instead of the sky.
Colour FrameRenderer::mirroredInFloor(const Picture& picture, const FloorPoint& point,
                                      const Vector& view, int x, int y) const {
  const Vector place(point.x, point.y, 0);
  const Frame mirror(Vector(view.x(), view.y(), -view.z()));
  const Sample* samples = samples_.at(x, y);
  const int count = std::max(1, picture.samples / 2);
  const float spread = texture_.gloss() * texture_.gloss() * 2;
  Colour sum = Colour::Zero();
  SurfaceHit hit;
  for (int i = 0; i < count; ++i) {
    const Sample& s = samples[i];
    // Long tails, as polished wood has them.
    const float wide =
        spread / std::sqrt(1.02f - s.specularX * s.specularX - s.specularY * s.specularY);
    const Vector d = mirror.toWorld(wide * s.specularX, wide * s.specularY, 1).normalized();
    if (d.z() <= 0) continue;
    if (picture.moment.intersect({place, d}, s.instant, s.choice, hit) == Moment::kNobody) continue;
    sum += roughRadiance(hit, -d, studio_) - studio_.softSky(d);
  }
  return sum * (point.mirrored * point.pool / static_cast<float>(count));
}

/// Radiance of the floor where the ray meets it.
/// @param blur  m, width over which its texture is averaged
Colour FrameRenderer::floorSeenFrom(const Picture& picture, const Ray& ray, float blur) const {
  const float distance = ray.origin.z() / std::max(-ray.direction.z(), 1e-4f);
  const Vector place = ray.origin + distance * ray.direction;
  FloorPoint point;
  point.albedo = blur > 0.1f ? texture_.mean()
                             : texture_.at(place.x(), place.y(), std::max(blur, 1e-3f),
                                           Eigen::Vector2f::Zero());
  point.x = place.x();
  point.y = place.y();
  point.pool = pool(point.x, point.y);
  return litFloor(picture, point, ray.direction);
}

/// Radiance that arrives along the ray at a body: other bodies, its own other parts, floor, sky.
/// @param except  a body that cannot be met, or kNobody
/// @param sharp   the lamps are seen
Colour FrameRenderer::around(const Picture& picture, const Ray& ray, const Sample& sample,
                             std::size_t except, float blur, bool sharp) const {
  if (except == Moment::kNobody || picture.moment.actors().size() > 1) {
    SurfaceHit hit;
    if (picture.moment.intersect(ray, sample.instant, sample.choice, hit, except) !=
        Moment::kNobody) {
      return roughRadiance(hit, -ray.direction, studio_);
    }
  }
  if (ray.direction.z() < 0) return floorSeenFrom(picture, ray, blur);
  return sharp ? studio_.sky(ray.direction) : studio_.softSky(ray.direction);
}

Colour FrameRenderer::shade(const Picture& picture, const Ray& ray, const SurfaceHit& hit,
                            const Sample& sample, std::size_t self) const {
  const Finish& finish = *hit.finish;
  const ActorMoment& actor = picture.moment.actors()[self];
  const std::size_t except = hit.open ? self : Moment::kNobody;
  const Vector view = -ray.direction;
  const Vector place =
      ray.origin + hit.distance * ray.direction + 3e-4f * actor.radius() * hit.geometric;
  const float facing = std::max(hit.normal.dot(view), 0.02f);
  const Colour through = 1 - (finish.facing() + (1 - finish.facing()) * schlick(facing));
  const Colour diffuse = finish.diffuse() / kPi * through;
  // Key light: its square is sampled for the diffuse part, and together with the lobe for the rest.
  Colour radiance = Colour::Zero();
  const Vector key = studio_.towardsKey(sample.key0, sample.key1);
  const float keyCosine = hit.normal.dot(key);
  const FinishLobe lobe(finish, hit.normal, view);
  if (keyCosine > 0 && hit.geometric.dot(key) > 0) {
    bool shadowed = false;
    if (except == Moment::kNobody || picture.moment.actors().size() > 1) {
      shadowed = picture.moment.occluded({place, key}, sample.instant, sample.choice, except);
    }
    if (!shadowed) {
      const float density = studio_.keyDensity(key);
      const float share = density / (density + lobe.density(key));
      radiance +=
          studio_.key(key) * (keyCosine / density) * (diffuse + share * lobe.reflectance(key));
    }
  }
  // Sky and floor, diffuse: what is known of them for the whole hemisphere, and by one ray how this
  // place differs.
  if (finish.metallic < 1) {
    const Vector d = cosineDirection(lobe.frame(), sample.diffuseX, sample.diffuseY);
    const Colour open = d.z() > 0 ? studio_.softSky(d) : studio_.floorRadiance();
    const Colour found = around(picture, {place, d}, sample, except, 1, false);
    radiance += diffuse * (studio_.ambient(hit.normal) + kPi * (found - open)).max(0.0f);
  }
  // What it mirrors.
  Colour weight;
  const Vector mirrored = lobe.sample(sample.specularX, sample.specularY, weight);
  if (mirrored.dot(hit.normal) > 0) {
    Colour seen =
        around(picture, {place, mirrored}, sample, except, 4 * finish.alpha * actor.radius(), true);
    if (mirrored.dot(hit.geometric) > 0 && (studio_.key(mirrored) > 0).any()) {
      const float density = lobe.density(mirrored);
      const float share = density / (density + studio_.keyDensity(mirrored));
      seen += share * studio_.key(mirrored);
    }
    radiance += weight * seen;
  }
  return radiance * picture.pools[self];
}

Colour FrameRenderer::pixel(const Picture& picture, const FloorPoint& point, int x, int y) const {
  const Ray middle =
      picture.camera.through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  Colour floor = litFloor(picture, point, middle.direction);
  if (point.mirrored > 0 && picture.mirrored.holds(x, y)) {
    floor += mirroredInFloor(picture, point, middle.direction, x, y);
  }
  floor = toned(floor);
  if (!picture.bodies.holds(x, y)) return floor;
  const Sample* samples = samples_.at(x, y);
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
      seen = toned(shade(picture, ray, hit, s, actor));
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
    picture.lights.emplace_back(actor, studio_, samples_, settings);
    picture.pools.push_back(pool(below.x(), below.y()));
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
      path_.at(time), Moment(actors_, time, settings_.shutterSeconds), {}, {}, 1, {}, {}, {}, {}};
  light(picture);
  if (path_.isFixed()) {
    picture.image = stillImage_;
    draw(picture, stillFloor_);
  } else {
    picture.image = Image(picture.camera.width, picture.camera.height);
    picture.shaded = {0, 0, picture.camera.width, picture.camera.height};
    draw(picture, floorLayer(picture.camera));
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
