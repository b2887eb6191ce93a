// SPDX-License-Identifier: Apache-2.0
#include "render/moment.h"

#include <algorithm>
#include <limits>

namespace ifa::render {
namespace {

thread_local long raysAsked = 0;

constexpr double kFadeIn = 0.12;  // s
// A motion that begins with the film needs no fading: nothing is seen of what was before.
constexpr double kAtOnce = 0.02;  // s

}  // namespace

Pose Actor::poseAt(double time) const {
  Pose pose = PoseTrack(*motion).at(time - start);
  pose.position += offset;
  return pose;
}

float Actor::presenceAt(double time) const {
  const double begin = motion->trajectory.front().time + start;
  if (begin < kAtOnce) return 1;
  return static_cast<float>(std::clamp((time - begin) / kFadeIn, 0.0, 1.0));
}

ActorMoment::ActorMoment(const Actor& actor, double open, double close)
    : geometry_(actor.geometry.get()), presence_(actor.presenceAt(0.5 * (open + close))) {
  lowest_ = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kInstants;
    const Pose pose = actor.poseAt(open + share * (close - open));
    placed_[i] = {pose.orientation.normalized().toRotationMatrix().cast<float>(),
                  pose.position.cast<float>()};
    lowest_ = std::min(lowest_, placed_[i].position.z());
  }
  centre_ = 0.5f * (placed_.front().position + placed_.back().position);
  for (const Placed& placed : placed_) {
    reach_ = std::max(reach_, (placed.position - centre_).norm());
  }
  reach_ += radius();
}

long ActorMoment::raysOfThisThread() { return raysAsked; }

// Most rays pass the body by; a sphere tells sooner than the tree does.
bool ActorMoment::misses(const Ray& ray, const Placed& placed) const {
  ++raysAsked;
  const Vector towards = placed.position - ray.origin;
  const float along = towards.dot(ray.direction);
  const float off = towards.squaredNorm() - along * along;
  const float square = radius() * radius();
  return off > square || (along < 0 && towards.squaredNorm() > square);
}

float ActorMoment::sweep() const {
  const Placed &first = placed_.front(), &last = placed_.back();
  const float turn =
      Eigen::AngleAxisf(Eigen::Matrix3f(first.worldFromBody.transpose() * last.worldFromBody))
          .angle();
  return (last.position - first.position).norm() + turn * radius();
}

Ray ActorMoment::inBody(const Ray& ray, const Placed& placed) {
  return {placed.worldFromBody.transpose() * (ray.origin - placed.position),
          placed.worldFromBody.transpose() * ray.direction};
}

bool ActorMoment::intersect(const Ray& ray, int instant, float limit, SurfaceHit& hit) const {
  const Placed& placed = at(instant);
  if (misses(ray, placed) || !geometry_->intersect(inBody(ray, placed), limit, hit)) return false;
  hit.normal = placed.worldFromBody * hit.normal;
  hit.geometric = placed.worldFromBody * hit.geometric;
  return true;
}

bool ActorMoment::occludes(const Ray& ray, int instant) const {
  const Placed& placed = at(instant);
  return !misses(ray, placed) && geometry_->occludes(inBody(ray, placed));
}

float ActorMoment::distance(const Ray& ray, int instant) const {
  const Placed& placed = at(instant);
  return misses(ray, placed) ? std::numeric_limits<float>::infinity()
                             : geometry_->distance(inBody(ray, placed));
}

Moment::Moment(const std::vector<Actor>& actors, double time, double opening) {
  for (const Actor& actor : actors) {
    actors_.emplace_back(actor, time - 0.5 * opening, time + 0.5 * opening);
  }
}

std::size_t Moment::intersect(const Ray& ray, int instant, float choice, SurfaceHit& hit,
                              std::size_t except) const {
  float limit = std::numeric_limits<float>::infinity();
  std::size_t nearest = kNobody;
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    if (i == except || choice >= actors_[i].presence()) continue;
    if (!actors_[i].intersect(ray, instant, limit, hit)) continue;
    limit = hit.distance;
    nearest = i;
  }
  return nearest;
}

bool Moment::occluded(const Ray& ray, int instant, float choice, std::size_t except) const {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    if (i == except || choice >= actors_[i].presence()) continue;
    if (actors_[i].occludes(ray, instant)) return true;
  }
  return false;
}

bool Moment::sameAs(const Moment& other) const {
  const auto still = [](const ActorMoment& a, const ActorMoment& b) {
    const auto same = [](const ActorMoment::Placed& p, const ActorMoment::Placed& q) {
      return p.position == q.position && p.worldFromBody == q.worldFromBody;
    };
    return a.presence() == b.presence() && same(a.at(0), a.at(kInstants - 1)) &&
           same(a.at(0), b.at(0)) && same(b.at(0), b.at(kInstants - 1));
  };
  return std::equal(actors_.begin(), actors_.end(), other.actors_.begin(), other.actors_.end(),
                    still);
}

}  // namespace ifa::render
