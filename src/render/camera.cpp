// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <algorithm>
#include <limits>

namespace ifa::render {
namespace {

constexpr float kElevation = 0.5f;    // rad above the floor
constexpr float kHalfHeight = 0.21f;  // tangent of half the angle of view: a short tele lens
// The floor must fill the picture: the upper edge looks down too.
static_assert(kElevation > kHalfHeight + 0.1f);
constexpr double kLeadIn = 0.04;        // s before the first contact that are framed
constexpr double kBallStep = 1 / 60.0;  // s
constexpr double kKnotStep = 1 / 30.0;  // s
// A body fills at most this share of the picture's height.
constexpr float kLargest = 0.42f;
// Turned from straight across the way that the body takes, so that depth shows.
constexpr float kTurn = 0.3f;  // rad

struct Following {
  double window;     // s that are framed around now
  double deviation;  // s, of the Gaussian that smooths the camera's way
};

Following followingOf(CameraKind kind) {
  if (kind == CameraKind::kFollow) return {0.45, 0.35};
  return {0.1, 0.16};
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
    : width_(width), height_(height) {
  chooseAzimuth(actors);
  gather(actors);
  const double infinite = std::numeric_limits<double>::infinity();
  const Knot whole = frame(-infinite, infinite, margins);
  middle_ = {whole.target.x(), whole.target.y(), 0};
  extent_ = whole.distance * kHalfHeight * static_cast<float>(width) / static_cast<float>(height);
  if (kind == CameraKind::kFixed) {
    knots_ = {whole};
    return;
  }
  const Following following = followingOf(kind);
  firstKnot_ = balls_.front().time;
  double last = firstKnot_;
  for (const Ball& ball : balls_) {
    firstKnot_ = std::min(firstKnot_, ball.time);
    last = std::max(last, ball.time);
  }
  for (double time = firstKnot_; time <= last + kKnotStep; time += kKnotStep) {
    const double near = std::min(time, last);
    knots_.push_back(frame(near - following.window, near + following.window, margins));
  }
  smooth(following.deviation);
}

void CameraPath::gather(const std::vector<Actor>& actors) {
  float largest = 0;
  for (const Actor& actor : actors) {
    const float radius = actor.geometry->radius();
    const auto& samples = actor.motion->trajectory;
    const double end = samples.back().time + actor.start;
    const double begin = std::max(samples.front().time, -kLeadIn) + actor.start;
    for (double time = std::min(begin, end);; time += kBallStep) {
      const double now = std::min(time, end);
      balls_.push_back({actor.poseAt(now).position.cast<float>(), radius, now});
      if (now >= end) break;
    }
    largest = std::max(largest, radius);
  }
  leastDistance_ = largest / (kLargest * kHalfHeight);
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
    float depth = 0;
    int count = 0;
    const auto include = [&](const Vector& centre, float radius) {
      const Vector d = centre - knot.target;
      const float z = std::max(knot.distance + d.dot(axes.forward), 0.2f * knot.distance);
      const Eigen::Array2f place(d.dot(axes.right) / z, d.dot(axes.up) / z);
      low = low.min(place - radius / z);
      high = high.max(place + radius / z);
      depth += z;
      ++count;
    };
    for (const Ball& ball : balls_) {
      if (ball.time < from || ball.time > to) continue;
      include(ball.centre, ball.radius);
      // The floor below: a contact is seen there, and a shadow.
      include({ball.centre.x(), ball.centre.y(), 0}, 0.6f * ball.radius);
    }
    depth /= static_cast<float>(count);
    const Eigen::Array2f middle = 0.5f * (low + high);
    const Eigen::Array2f wanted(0.5f * (left + right), 0.5f * (top + bottom));
    knot.target += ((middle - wanted).x() * axes.right + (middle - wanted).y() * axes.up) * depth;
    const float scale =
        std::max((high - low).x() / (right - left), (high - low).y() / (top - bottom));
    knot.distance = std::max(leastDistance_, knot.distance * (0.4f + 0.6f * scale));
  }
  return knot;
}

void CameraPath::smooth(double deviation) {
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3 * deviation / kKnotStep));
  const auto count = static_cast<std::ptrdiff_t>(knots_.size());
  std::vector<Knot> smoothed(knots_.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    Vector target = Vector::Zero();
    float distance = 0, weights = 0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const Knot& knot =
          knots_[static_cast<std::size_t>(std::clamp(i + k, std::ptrdiff_t{0}, count - 1))];
      const double x = static_cast<double>(k) * kKnotStep / deviation;
      const auto weight = static_cast<float>(std::exp(-0.5 * x * x));
      target += weight * knot.target;
      distance += weight * knot.distance;
      weights += weight;
    }
    smoothed[static_cast<std::size_t>(i)] = {target / weights, distance / weights};
  }
  knots_ = std::move(smoothed);
}

Camera CameraPath::cameraOf(const Knot& knot) const {
  Camera camera;
  camera.halfHeight = kHalfHeight;
  camera.width = width_;
  camera.height = height_;
  const float c = std::cos(azimuth_), s = std::sin(azimuth_);
  camera.forward = {c * std::cos(kElevation), s * std::cos(kElevation), -std::sin(kElevation)};
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
