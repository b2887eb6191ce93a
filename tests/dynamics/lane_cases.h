// SPDX-License-Identifier: Apache-2.0
// Random states and contacts for the lanes of packs, and whether those lanes part.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "base/random.h"
#include "dynamics/contact_solver.h"
#include "dynamics/kernel_state.h"
#include "support/box_body.h"
#include "support/lane_pack.h"

namespace ifa {

inline constexpr int kPacks = 400;

/// How often lanes of one pack went different ways.
class Parting {
 public:
  void add(int way) { ways_.insert(way); }
  void endOfPack() {
    parted_ += ways_.size() > 1 ? 1 : 0;
    ways_.clear();
  }
  [[nodiscard]] int count() const { return parted_; }

 private:
  std::set<int> ways_;
  int parted_ = 0;
};

inline Vec<double> randomVec(RandomStream& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

inline Quat<double> randomTurn(RandomStream& random) {
  const Vec<double> v = randomVec(random, 1);
  return normalised(Quat<double>{random.uniform(-1, 1), v.x, v.y, v.z});
}

/// Not too near the ground, nor too far.
inline KernelState<double> randomState(const BodyModel& model, RandomStream& random) {
  KernelState<double> s;
  s.time = random.uniform(0, 3);
  s.position = randomVec(random, 1);
  s.position.z = model.radius * random.uniform(0.2, 2);
  s.q = randomTurn(random);
  s.velocity = randomVec(random, 1);
  if (random.uniform() < 0.2) s.velocity.x = -0.0;  // which is not what -0 + 0 is
  s.w = randomVec(random, 20);
  return s;
}

/// None to all of the points that a contact can have, at vertices of a body that is as in `s`.
inline ContactSolver<double> randomContact(const BodyModel& model, const KernelState<double>& s,
                                           RandomStream& random) {
  ContactSolver<double> solver;
  const Rotation<double> rotation(s.q);
  const Vec<double> spin = rotation * s.w;
  solver.count = static_cast<int>(random.below(ContactSolver<double>::kMaxPoints + 1));
  solver.rollingArm = random.uniform() < 0.5 ? 0 : model.surface.rollingFriction;
  solver.moment = randomVec(random, 1e-6);
  solver.spinTarget = randomVec(random, 1);
  for (int k = 0; k < solver.count; ++k) {
    ContactPoint<double>& p = solver.points[k];
    const auto vertex = static_cast<std::size_t>(random.below(model.x.size()));
    p.place = {model.x[vertex], model.y[vertex], model.z[vertex]};
    p.r = rotation * p.place;
    p.gap = random.uniform(-2, 2) * model.hitGap;
    p.rate = (s.velocity + cross(spin, p.r)).z;
    p.impulse = {0, 0, random.uniform() < 0.5 ? 0 : model.mass * random.uniform(0, 0.1)};
    p.target = {0, 0, random.uniform(0, 0.3)};
  }
  return solver;
}

/// A body of each kind of inertia, with rolling friction and without.
inline std::vector<BodyModel> models() {
  std::vector<BodyModel> all;
  for (const double rolling : {0.0, 3e-4}) {
    SurfaceProperties surface;
    surface.friction = 0.6;
    surface.rollingFriction = surface.spinningFriction = rolling;
    for (const Body& body : {makeDieBody(), makePrismBody(24, 0.03, 0.05, 0.1),
                             makeBoxBody({0.06, 0.02, 0.011}, 0.02)}) {
      all.emplace_back(body, surface);
    }
  }
  return all;
}

template <class P>
class Lanes : public testing::Test {
 protected:
  static constexpr std::size_t kCount = LaneTraits<P>::kLanes;
  template <class T>
  using Each = std::array<T, kCount>;

  /// Runs `test` for packs of random lanes of every body; lanes must part in half of them.
  template <class F>
  void onEveryBody(const F& test) {
    const std::vector<BodyModel> all = models();
    Parting parting;
    for (std::size_t m = 0; m < all.size(); ++m) {
      RandomStream random(kCount, m);
      for (int pack = 0; pack < kPacks && !this->HasFailure(); ++pack) {
        test(all[m], random, parting);
        parting.endOfPack();
      }
    }
    if (kCount > 1) {
      EXPECT_GT(parting.count(), kPacks * static_cast<int>(all.size()) / 2);
    }
  }
};

}  // namespace ifa
