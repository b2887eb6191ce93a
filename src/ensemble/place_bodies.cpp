// SPDX-License-Identifier: Apache-2.0
#include "ensemble/place_bodies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "ensemble/hull_gap.h"

namespace ifa {

namespace {

using Eigen::Vector2d;

constexpr double kBin = 0.02;    // s over which one greatest speed holds
constexpr double kSlack = 0.25;  // m/s that a body may be faster between two samples
constexpr int kTurns = 8;        // directions tried at each spot
constexpr double kRing = 0.5;    // from ring to ring, as a share of the largest body's size
constexpr int kMostRings = 400;

/// A member with what placing asks about it again and again. Own frame: where the motion was made.
class Walker {
 public:
  explicit Walker(const EnsembleMember& member)
      : motion_(*member.motion), hull_{&member.body->hull, member.body->radius}, track_(motion_) {
    const auto& samples = motion_.trajectory;
    const auto bins = static_cast<std::size_t>((track_.end() - track_.start()) / kBin) + 1;
    fastest_.assign(bins, 0);
    for (const MotionSample& sample : samples) {
      const double speed = sample.velocity.norm() + sample.angularVelocity.norm() * hull_.radius;
      const double bin = (sample.time - track_.start()) / kBin;
      // A sample speaks for what is before it and after it.
      for (const double near : {bin - 0.25, bin + 0.25}) {
        auto& fastest = fastest_[static_cast<std::size_t>(
            std::clamp(near, 0.0, static_cast<double>(bins - 1)))];
        fastest = std::max(fastest, speed + kSlack);
      }
      if (sample.time >= 0) heard_.extend(Vector2d(sample.position.head<2>()));
    }
  }

  [[nodiscard]] double begin() const { return track_.start() + motion_.sound.firstContact; }
  [[nodiscard]] double end() const { return track_.end() + motion_.sound.firstContact; }
  [[nodiscard]] const Hull& hull() const { return hull_; }
  /// Middle of the floor that it covers from its first contact on.
  [[nodiscard]] Vector2d middle() const { return heard_.center(); }
  [[nodiscard]] Pose at(double time, const FloorPlace& place) const {
    return place.apply(track_.at(time - motion_.sound.firstContact));
  }
  /// Greatest speed of any of its points in the bin of `time`, m/s; 0 at rest.
  [[nodiscard]] double speedAt(double time) const {
    const double bin = (time - begin()) / kBin;
    return time >= end() ? 0
                         : fastest_[std::min(static_cast<std::size_t>(bin), fastest_.size() - 1)];
  }
  /// s until another speed holds.
  [[nodiscard]] double binLeft(double time) const {
    const double bin = (time - begin()) / kBin;
    return (std::floor(bin) + 1 - bin) * kBin + 1e-9;
  }

 private:
  const Motion& motion_;
  Hull hull_;
  PoseTrack track_;
  std::vector<double> fastest_;
  Eigen::AlignedBox2d heard_;
};

struct Placed {
  const Walker* walker;
  FloorPlace place;
};

/// Whether they keep `clearance` at all times.
bool keepApart(const Placed& one, const Placed& other, double clearance) {
  // Steps assume half a millimetre more, so that they never get too short.
  constexpr double kStepRoom = 5e-4;
  double time = std::max(one.walker->begin(), other.walker->begin());
  const double end = std::max({one.walker->end(), other.walker->end(), time});
  while (true) {
    const double speed = one.walker->speedAt(time) + other.walker->speedAt(time);
    const double enough = clearance + kStepRoom + speed * kBin;
    const double gap = hullGap(one.walker->hull(), one.walker->at(time, one.place),
                               other.walker->hull(), other.walker->at(time, other.place), enough);
    if (gap < clearance + kStepRoom) return false;
    if (time >= end) return true;
    const double step = std::min({speed > 0 ? (gap - clearance) / speed : kBin,
                                  one.walker->binLeft(time), other.walker->binLeft(time)});
    time = std::min(time + step, end);
  }
}

/// Spots on rings around the middle, nearest first, and turns; the seed says where rings begin.
class Spots {
 public:
  Spots(std::uint64_t seed, std::size_t member, double ring)
      : random_(seed, 0xE5E3B1E0 + member), ring_(ring) {
    phase_ = random_.uniform(0, 2 * std::numbers::pi);
    turn_ = random_.uniform(0, 2 * std::numbers::pi);
  }

  /// @return whether there was a place for which `fits` is true; it is the last one asked about
  template <class Fits>
  bool find(const Fits& fits) const {
    for (int ring = 0; ring < kMostRings; ++ring) {
      const double radius = ring * ring_;
      const int count = std::max(1, static_cast<int>(2 * std::numbers::pi * ring));
      for (int i = 0; i < count; ++i) {
        const double angle = phase_ + 2 * std::numbers::pi * i / count;
        const Vector2d spot = radius * Vector2d(std::cos(angle), std::sin(angle));
        for (int k = 0; k < kTurns; ++k) {
          if (fits(spot, turn_ + 2 * std::numbers::pi * k / kTurns)) return true;
        }
      }
    }
    return false;
  }

 private:
  RandomStream random_;
  double ring_, phase_ = 0, turn_ = 0;
};

}  // namespace

Result<std::vector<FloorPlace>> placeBodies(const std::vector<EnsembleMember>& members,
                                            const PlacingSettings& settings,
                                            const Progress& progress) {
  std::vector<Walker> walkers;
  double largest = 0;
  for (const EnsembleMember& member : members) {
    walkers.emplace_back(member);
    largest = std::max(largest, member.body->size);
  }
  std::vector<Placed> placed;
  std::vector<FloorPlace> places;
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    progress("place", static_cast<double>(i) / static_cast<double>(walkers.size()));
    Placed next{&walkers[i], {}};
    const bool found =
        Spots(settings.seed, i, kRing * largest).find([&](const Vector2d& spot, double turn) {
          next.place.turn = turn;
          next.place.shift = spot - Eigen::Rotation2Dd(turn) * walkers[i].middle();
          return !progress.stopRequested() &&
                 std::all_of(placed.begin(), placed.end(), [&](const Placed& other) {
                   return keepApart(next, other, settings.clearance);
                 });
        });
    if (progress.stopRequested()) {
      return tl::unexpected<Error>({ErrorCode::kInterrupted, "interrupted", {}, {}});
    }
    if (!found) {
      return tl::unexpected<Error>({ErrorCode::kNoMotion,
                                    "no free place on the floor for body " + std::to_string(i + 1),
                                    {},
                                    "a smaller clearance, or fewer bodies, would help"});
    }
    placed.push_back(next);
    places.push_back(next.place);
  }
  return places;
}

}  // namespace ifa
