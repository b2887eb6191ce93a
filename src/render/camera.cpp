// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <algorithm>
#include <limits>

namespace ifa::render {
namespace {

constexpr float kElevation = 0.5f;    // rad above the floor
constexpr float kHalfHeight = 0.21f;  // tangent of half the angle of view: a short tele lens
// The floor must fill the picture, unless the eye is low: the upper edge looks down too.
static_assert(kElevation > kHalfHeight + 0.1f);
// Height of a low eye as a share of its distance. The floor around the body is within half a pixel
// of the horizon, yet each ray that goes down has a place on the floor.
constexpr float kLowEye = 2e-4f;
constexpr double kLeadIn = 0.04;        // s before the first contact that are framed
constexpr double kBallStep = 1 / 60.0;  // s
constexpr double kKnotStep = 1 / 30.0;  // s
// A body fills at most this share of the picture's height.
constexpr float kLargest = 0.42f, kLargestFromAfar = 0.26f;
// Turned from straight across the way that the body takes, so that depth shows.
constexpr float kTurn = 0.3f;  // rad

// A camera that stands still shows the body at least this high, as a share of the picture.
constexpr float kSmallest = 0.075f;

/// What a moving camera frames around now, and how smooth its way is.
struct Following {
  double before, after;  // s
  double deviation;      // s, of the Gaussian that smooths it
};

Following followingOf(CameraKind kind) {
  if (kind == CameraKind::kAuto) return {0.25, 0.45, 0.4};
  if (kind == CameraKind::kFollow) return {0.2, 0.3, 0.25};
  return {0.1, 0.1, 0.16};
}

/// Gaussian mean of `value(i)` around each of `count` places, the ends held.
template <class T, class Value>
std::vector<T> smoothed(std::size_t count, double deviation, const T& zero, const Value& value) {
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3 * deviation / kKnotStep));
  const auto last = static_cast<std::ptrdiff_t>(count) - 1;
  std::vector<T> result;
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    T sum = zero;
    float weights = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const double x = static_cast<double>(k) * kKnotStep / deviation;
      const auto weight = static_cast<float>(std::exp(-0.5 * x * x));
      sum += weight * value(static_cast<std::size_t>(std::clamp(i + k, std::ptrdiff_t{0}, last)));
      weights += weight;
    }
    result.push_back(sum / weights);
  }
  return result;
}

}  // namespace

Ray Camera::through(float x, float y) const {
  const float scale = 2 * halfHeight / static_cast<float>(height);
  const float across = (x - 0.5f * static_cast<float>(width)) * scale;
  const float upwards = (0.5f * static_cast<float>(height) - y) * scale;
  return {eye, (forward + across * right + upwards * up).normalized()};
}

Vector Camera::project(const Vector& point) const {
  const Vector d = point - eye;
  const float depth = std::max(d.dot(forward), 1e-4f);
  const float scale = static_cast<float>(height) / (2 * halfHeight * depth);
  return {0.5f * static_cast<float>(width) + d.dot(right) * scale,
          0.5f * static_cast<float>(height) - d.dot(up) * scale, depth};
}

bool Camera::operator==(const Camera& other) const {
  return eye == other.eye && forward == other.forward && width == other.width &&
         height == other.height;
}

CameraPath::CameraPath(CameraKind kind, const std::vector<Actor>& actors, int width, int height,
                       const FrameMargins& margins)
    : isLow_(kind == CameraKind::kLow),
      // A low camera looks up until the horizon is at the margin.
      elevation_(isLow_ ? -std::atan(kHalfHeight * (1 - 2 * margins.bottom)) : kElevation),
      width_(width),
      height_(height) {
  chooseAzimuth(actors);
  gather(actors);
  const bool isNear = kind == CameraKind::kFixed || kind == CameraKind::kCloseUp || isLow_;
  leastDistance_ = largest_ / ((isNear ? kLargest : kLargestFromAfar) * kHalfHeight);
  const double infinite = std::numeric_limits<double>::infinity();
  const Knot whole = frame(-infinite, infinite, margins);
  middle_ = {whole.target.x(), whole.target.y(), 0};
  extent_ = whole.distance * kHalfHeight * static_cast<float>(width) / static_cast<float>(height);
  const float share = largest_ / (kHalfHeight * whole.distance);
  if (kind == CameraKind::kFixed || isLow_ || (kind == CameraKind::kAuto && share >= kSmallest)) {
    knots_ = {whole};
    return;
  }
  follow(kind, margins);
}

void CameraPath::follow(CameraKind kind, const FrameMargins& margins) {
  const Following following = followingOf(kind);
  firstKnot_ = balls_.front().time;
  double last = firstKnot_;
  for (const Ball& ball : balls_) {
    firstKnot_ = std::min(firstKnot_, ball.time);
    last = std::max(last, ball.time);
  }
  for (double time = firstKnot_; time <= last + kKnotStep; time += kKnotStep) {
    const double now = std::min(time, last);
    knots_.push_back(frame(now - following.before, now + following.after, margins));
  }
  smooth(following.deviation);
  keepInView(margins);
}

// Who has come to rest stays in the picture until all have.
void CameraPath::gather(const std::vector<Actor>& actors) {
  double end = -std::numeric_limits<double>::infinity();
  for (const Actor& actor : actors) {
    end = std::max(end, actor.motion->trajectory.back().time + actor.start);
  }
  for (const Actor& actor : actors) {
    const float radius = actor.geometry->radius();
    const auto& samples = actor.motion->trajectory;
    const double begin = std::max(samples.front().time, -kLeadIn) + actor.start;
    for (double time = std::min(begin, end);; time += kBallStep) {
      const double now = std::min(time, end);
      balls_.push_back({actor.poseAt(now).position.cast<float>(), radius, now});
      if (now >= end) break;
    }
    largest_ = std::max(largest_, radius);
  }
}

// Across the way that the bodies take, left to right, so that most of it is seen.
void CameraPath::chooseAzimuth(const std::vector<Actor>& actors) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Actor& actor : actors) {
    const auto& samples = actor.motion->trajectory;
    const Eigen::Vector3d way =
        samples.back().position - actor.poseAt(actor.start - kLeadIn).position + actor.offset;
    sum += way.head<2>();
  }
  if (sum.norm() < 1e-6) sum = {1, 0};
  azimuth_ = static_cast<float>(std::atan2(sum.y(), sum.x())) + 0.5f * kPi - kTurn;
}

CameraPath::Knot CameraPath::frame(double from, double to, const FrameMargins& margins) const {
  const Camera axes = cameraOf({});
  const float aspect = static_cast<float>(width_) / static_cast<float>(height_);
  const float halfWidth = kHalfHeight * aspect;
  // Borders of the free part of the picture, as tangents from the axis of view.
  const float left = -halfWidth * (1 - 2 * margins.side), right = -left;
  const float top = kHalfHeight * (1 - 2 * margins.top);
  const float bottom = -kHalfHeight * (1 - 2 * margins.bottom);
  Knot knot;
  bool first = true;
  for (const Ball& ball : balls_) {
    if (ball.time < from || ball.time > to) continue;
    if (first) knot.target = ball.centre;
    first = false;
  }
  knot.distance = leastDistance_;
  for (int round = 0; round < 24; ++round) {
    Eigen::Array2f low = Eigen::Array2f::Constant(1e9f), high = -low;
    float depth = 0, nearest = 0;
    int count = 0;
    const auto include = [&](const Vector& centre, float radius) {
      const Vector d = centre - knot.target;
      const float z = std::max(knot.distance + d.dot(axes.forward), 0.2f * knot.distance);
      const Eigen::Array2f place(d.dot(axes.right) / z, d.dot(axes.up) / z);
      low = low.min(place - radius / z);
      high = high.max(place + radius / z);
      depth += z;
      nearest = std::max(nearest, radius - d.dot(axes.forward));
      ++count;
    };
    for (const Ball& ball : balls_) {
      if (ball.time < from || ball.time > to) continue;
      include(ball.centre, ball.radius);
      // The floor below: a contact is seen there, and a shadow.
      include({ball.centre.x(), ball.centre.y(), 0}, 0.6f * ball.radius);
    }
    depth /= static_cast<float>(count);
    if (isLow_) low.y() = bottom;  // the horizon: bodies reach below it as balls only
    const Eigen::Array2f middle = 0.5f * (low + high);
    const Eigen::Array2f wanted(0.5f * (left + right), 0.5f * (top + bottom));
    // A low camera's height is not free.
    const float upwards = isLow_ ? 0 : (middle - wanted).y();
    knot.target += ((middle - wanted).x() * axes.right + upwards * axes.up) * depth;
    const float scale =
        std::max((high - low).x() / (right - left), (high - low).y() / (top - bottom));
    knot.distance = std::max(leastDistance_, knot.distance * (0.4f + 0.6f * scale));
    if (isLow_) {
      knot.distance = std::max(knot.distance, 1.25f * nearest);  // bodies stay before the eye
      knot.target.z() = knot.distance * (kLowEye + axes.forward.z());
    }
  }
  return knot;
}

void CameraPath::smooth(double deviation) {
  const auto targets = smoothed<Vector>(knots_.size(), deviation, Vector::Zero(),
                                        [&](std::size_t i) { return knots_[i].target; });
  const auto distances = smoothed<float>(knots_.size(), deviation, 0,
                                         [&](std::size_t i) { return knots_[i].distance; });
  for (std::size_t i = 0; i < knots_.size(); ++i) knots_[i] = {targets[i], distances[i]};
}

// A smooth way may lag behind the body: the camera goes back as far as it must, in time and softly.
void CameraPath::keepInView(const FrameMargins& margins) {
  constexpr double kSoftness = 0.2;  // s
  std::vector<float> needed(knots_.size(), 1);
  for (const Ball& ball : balls_) {
    const Camera camera = at(ball.time);
    const Vector seen = camera.project(ball.centre);
    const float radius = ball.radius / camera.pixelAt(seen.z());
    const float x = std::abs(2 * seen.x() / static_cast<float>(width_) - 1) +
                    2 * radius / static_cast<float>(width_) + 2 * margins.side;
    const float y = 1 - 2 * seen.y() / static_cast<float>(height_);  // 1: upper edge
    const float ends =
        2 * radius / static_cast<float>(height_) + 2 * (y > 0 ? margins.top : margins.bottom);
    auto& need = needed[static_cast<std::size_t>(std::clamp(
        (ball.time - firstKnot_) / kKnotStep, 0.0, static_cast<double>(needed.size() - 1)))];
    need = std::max({need, x, std::abs(y) + ends});
  }
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3 * kSoftness / kKnotStep)) + 1;
  const auto last = static_cast<std::ptrdiff_t>(needed.size()) - 1;
  const auto largest = [&](std::size_t i) {
    const auto middle = static_cast<std::ptrdiff_t>(i);
    return *std::max_element(needed.begin() + std::max(std::ptrdiff_t{0}, middle - reach),
                             needed.begin() + std::min(last, middle + reach) + 1);
  };
  const auto factors = smoothed<float>(needed.size(), kSoftness, 0, largest);
  for (std::size_t i = 0; i < knots_.size(); ++i) knots_[i].distance *= factors[i];
}

Camera CameraPath::cameraOf(const Knot& knot) const {
  Camera camera;
  camera.halfHeight = kHalfHeight;
  camera.width = width_;
  camera.height = height_;
  const float c = std::cos(azimuth_), s = std::sin(azimuth_);
  camera.forward = {c * std::cos(elevation_), s * std::cos(elevation_), -std::sin(elevation_)};
  camera.right = {s, -c, 0};
  camera.up = camera.right.cross(camera.forward);
  camera.eye = knot.target - knot.distance * camera.forward;
  return camera;
}

Camera CameraPath::at(double time) const {
  const double place =
      std::clamp((time - firstKnot_) / kKnotStep, 0.0, static_cast<double>(knots_.size() - 1));
  const auto index = static_cast<std::size_t>(place);
  const auto& from = knots_[index];
  const auto& to = knots_[std::min(index + 1, knots_.size() - 1)];
  const auto share = static_cast<float>(place - static_cast<double>(index));
  return cameraOf({from.target + share * (to.target - from.target),
                   from.distance + share * (to.distance - from.distance)});
}

}  // namespace ifa::render
