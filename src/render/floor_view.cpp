// SPDX-License-Identifier: Apache-2.0
#include "render/floor_view.h"

#include <algorithm>

#include "base/parallel.h"

namespace ifa::render {
namespace {

// Of the sky's light at least this share arrives everywhere.
constexpr float kLeastSky = 0.04f;
// The floor's varnish loses this share of what a mirror would show.
constexpr float kVarnish = 0.55f;
// The grain runs a little askew to the picture's edges.
constexpr float kAskew = 0.16f;  // rad
// Over so wide a blur the texture is its mean.
constexpr float kMeanFrom = 0.1f;  // m

/// What is seen above the horizon: a wall far behind, brightest below, so that the lower side of a
/// body, which little light reaches, stands out from it.
Colour backdrop(const Vector& view) {
  return Colour(0.62f, 0.64f, 0.70f) * std::max(1 - 2 * view.z(), 0.0f);
}

}  // namespace

FloorView::FloorView(const std::string& surface, const CameraPath& path)
    : texture_(surface),
      studio_(path.azimuth(), texture_.mean()),
      middle_(path.middle()),
      extent_(path.extent()) {
  const float turn = path.azimuth() - 0.5f * kPi - kAskew;
  grain_ = {std::cos(turn), std::sin(turn)};
}

// The eye stays where the light is, around what happens.
float FloorView::pool(float x, float y) const {
  const float away =
      (Eigen::Vector2f(x, y) - middle_.head<2>()).squaredNorm() / (extent_ * extent_);
  const float fall = 1 / (1 + 0.25f * away);
  return 0.42f + 0.58f * fall * fall;
}

Eigen::Vector2f FloorView::alongGrain(const Eigen::Vector2f& v) const {
  return {grain_.x() * v.x() + grain_.y() * v.y(), grain_.x() * v.y() - grain_.y() * v.x()};
}

FloorPoint FloorView::point(const Camera& camera, int x, int y) const {
  const Ray ray = camera.through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  FloorPoint point;
  point.above = ray.direction.z() >= 0;
  if (point.above) return point;
  const float distance = -ray.origin.z() / ray.direction.z();
  const Vector place = ray.origin + distance * ray.direction;
  const float across = camera.pixelAt(distance * ray.direction.dot(camera.forward));
  const Eigen::Vector2f along = across / -ray.direction.z() * ray.direction.head<2>().normalized();
  const Eigen::Vector2f uv = alongGrain(place.head<2>());
  point.albedo = texture_.at(uv.x(), uv.y(), across, alongGrain(along));
  point.x = place.x();
  point.y = place.y();
  point.pool = pool(place.x(), place.y());
  if (gloss() > 0) point.mirrored = kVarnish * (0.04f + 0.96f * schlick(-ray.direction.z()));
  return point;
}

std::vector<FloorPoint> FloorView::layer(const Camera& camera) const {
  const auto width = static_cast<std::size_t>(camera.width);
  std::vector<FloorPoint> points(width * static_cast<std::size_t>(camera.height));
  parallelFor(static_cast<std::size_t>(camera.height), [&](std::size_t row) {
    for (std::size_t x = 0; x < width; ++x) {
      points[row * width + x] = point(camera, static_cast<int>(x), static_cast<int>(row));
    }
  });
  return points;
}

Colour FloorView::lit(const FloorPoint& point, const Vector& view,
                      const std::vector<FloorLight>& lights) const {
  if (point.above) return backdrop(view);
  float key = 1;
  Colour sky = studio_.skyOnFloor();
  for (const FloorLight& light : lights) {
    key *= light.key(point.x, point.y);
    sky += light.ambient(point.x, point.y);
  }
  sky = sky.max(kLeastSky * studio_.skyOnFloor());
  const Vector mirror(view.x(), view.y(), -view.z());
  return point.pool * (point.albedo / kPi * (key * studio_.keyOnFloor() + sky) +
                       point.mirrored * studio_.softSky(mirror));
}

Colour FloorView::seenFrom(const Ray& ray, float blur,
                           const std::vector<FloorLight>& lights) const {
  const float distance = ray.origin.z() / std::max(-ray.direction.z(), 1e-4f);
  const Vector place = ray.origin + distance * ray.direction;
  const Eigen::Vector2f uv = alongGrain(place.head<2>());
  FloorPoint point;
  point.albedo = blur > kMeanFrom
                     ? texture_.mean()
                     : texture_.at(uv.x(), uv.y(), std::max(blur, 1e-3f), Eigen::Vector2f::Zero());
  point.x = place.x();
  point.y = place.y();
  point.pool = pool(point.x, point.y);
  return lit(point, ray.direction, lights);
}

}  // namespace ifa::render
