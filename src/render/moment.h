// SPDX-License-Identifier: Apache-2.0
// The bodies while the shutter is open, and rays among them.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "model/pose_track.h"
#include "render/body_geometry.h"
#include "render/sample_table.h"

namespace ifa::render {

/// A body with the motion that it makes. Times of the stage: s, `start` is the motion's time 0.
struct Actor {
  std::shared_ptr<const BodyGeometry> geometry;
  std::shared_ptr<const Motion> motion;
  double start = 0;                                  ///< s of the stage at the first contact
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m, added to positions

  /// Pose at a time of the stage.
  [[nodiscard]] Pose poseAt(double time) const;
  /// 0 to 1: a body that would hang in the air before its motion begins is not there, and fades in.
  [[nodiscard]] float presenceAt(double time) const;
};

/// One body at kInstants instants between `open` and `close`. The actor must outlive it.
class ActorMoment {
 public:
  struct Placed {
    Eigen::Matrix3f worldFromBody;
    Vector position;
  };

  ActorMoment(const Actor& actor, double open, double close);

  /// Rays that this thread has asked about so far, those that pass by included.
  [[nodiscard]] static long raysOfThisThread();
  /// Nearest hit closer than `limit`, world frame.
  bool intersect(const Ray& ray, int instant, float limit, SurfaceHit& hit) const;
  [[nodiscard]] bool occludes(const Ray& ray, int instant) const;
  /// Distance of the nearest hit, or infinity.
  [[nodiscard]] float distance(const Ray& ray, int instant) const;
  [[nodiscard]] const Placed& at(int instant) const {
    return placed_[static_cast<std::size_t>(instant)];
  }
  [[nodiscard]] float radius() const { return geometry_->radius(); }
  [[nodiscard]] float presence() const { return presence_; }
  /// Sphere that holds the body at every instant.
  [[nodiscard]] const Vector& centre() const { return centre_; }
  [[nodiscard]] float reach() const { return reach_; }
  /// How far a place of the body's surface moves while the shutter is open at most, m.
  [[nodiscard]] float sweep() const;
  /// Least height of the middle of the body, m.
  [[nodiscard]] float lowest() const { return lowest_; }

 private:
  [[nodiscard]] bool misses(const Ray& ray, const Placed& placed) const;
  [[nodiscard]] static Ray inBody(const Ray& ray, const Placed& placed);

  const BodyGeometry* geometry_;
  std::array<Placed, kInstants> placed_;
  float presence_ = 1, reach_ = 0, lowest_ = 0;
  Vector centre_;
};

/// All bodies while the shutter is open. The actors must outlive it.
class Moment {
 public:
  /// @param time     s of the stage, the middle of the opening
  /// @param opening  s, >= 0
  Moment(const std::vector<Actor>& actors, double time, double opening);

  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  /// @param choice  in [0, 1): whether bodies that fade in are there
  /// @param except  number of a body that is left out
  /// @return number of the body that is hit first, or kNobody
  std::size_t intersect(const Ray& ray, int instant, float choice, SurfaceHit& hit,
                        std::size_t except = kNobody) const;
  [[nodiscard]] bool occluded(const Ray& ray, int instant, float choice, std::size_t except) const;
  [[nodiscard]] const std::vector<ActorMoment>& actors() const { return actors_; }
  /// True when nothing moves and nothing fades: the same picture as `other`.
  [[nodiscard]] bool sameAs(const Moment& other) const;

 private:
  std::vector<ActorMoment> actors_;
};

}  // namespace ifa::render
