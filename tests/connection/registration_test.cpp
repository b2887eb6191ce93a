// SPDX-License-Identifier: Apache-2.0
// Registration by motions of the plane: against a scan over all turns, and what it leaves alone.
#include "connection/registration.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "connection/connection_cases.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using test::randomState;

RandomStream anyStream() { return {*rc::gen::arbitrary<std::uint64_t>(), 3}; }

PlanarTransform randomTransform(RandomStream& random) {
  const double half = random.uniform(-3, 3);
  return {std::cos(half), std::sin(half), random.uniform(-1, 1), random.uniform(-1, 1)};
}

void expectNear(const RigidState& a, const RigidState& b, double tolerance) {
  RC_ASSERT((a.position - b.position).norm() < tolerance);
  RC_ASSERT(test::angleBetween(a.orientation, b.orientation) < tolerance);
  RC_ASSERT((a.velocity - b.velocity).norm() < tolerance);
  RC_ASSERT((a.angularVelocity - b.angularVelocity).norm() < 100 * tolerance);
}

TEST(Registration, FindsTheMotionThatWasMade) {
  EXPECT_TRUE(rc::check("registering a moved state undoes the motion", [] {
    RandomStream random = anyStream();
    const RigidState state = randomState(random);
    const RigidState moved = randomTransform(random).apply(state);
    const Registration back = registerState(moved, state);
    expectNear(back.transform.apply(moved), state, 1e-12);
    RC_ASSERT(back.angle < 1e-12);
  }));
}

TEST(Registration, NoOtherTurnIsBetter) {
  EXPECT_TRUE(rc::check("the angle left is the smallest of all turns", [] {
    RandomStream random = anyStream();
    const RigidState moved = randomState(random), onto = randomState(random);
    const Registration best = registerState(moved, onto);
    const RigidState laid = best.transform.apply(moved);
    RC_ASSERT(std::abs(test::angleBetween(laid.orientation, onto.orientation) - best.angle) < 1e-7);
    RC_ASSERT((laid.position - onto.position).head<2>().norm() < 1e-12);
    RC_ASSERT(laid.position.z() == moved.position.z());
    for (int degree = 0; degree < 360; ++degree) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(degree * 0.0174532925, Vector3d::UnitZ()));
      const double left = test::angleBetween(turn * moved.orientation, onto.orientation);
      RC_ASSERT(left > best.angle - 1e-7);
    }
  }));
}

TEST(Registration, AngleIsThatBetweenTheNormals) {
  EXPECT_TRUE(rc::check("residual angle == angle between keys == 2 acos sqrt(w^2 + z^2)", [] {
    RandomStream random = anyStream();
    const RigidState a = randomState(random), b = randomState(random);
    const double angle = registerState(a, b).angle;
    RC_ASSERT(std::abs(angle - angleBetween(planarKey(a), planarKey(b))) < 1e-9);
    const Eigen::Quaterniond r = b.orientation * a.orientation.conjugate();
    const double printed = 2 * std::acos(std::min(1.0, std::hypot(r.w(), r.z())));
    RC_ASSERT(std::abs(angle - printed) < 1e-7);
  }));
}

TEST(Registration, KeyDoesNotSeeMotionsOfThePlane) {
  EXPECT_TRUE(rc::check("planarKey(apply(state)) == planarKey(state)", [] {
    RandomStream random = anyStream();
    const RigidState state = randomState(random);
    const PlanarKey a = planarKey(state), b = planarKey(randomTransform(random).apply(state));
    RC_ASSERT((a.up - b.up).norm() < 1e-13);
    RC_ASSERT((a.velocity - b.velocity).norm() < 1e-12);
    RC_ASSERT((a.angularVelocity - b.angularVelocity).norm() < 1e-11);
  }));
}

TEST(Registration, MotionsOfThePlaneFollowEachOther) {
  EXPECT_TRUE(rc::check("second.after(first) is first, then second", [] {
    RandomStream random = anyStream();
    const RigidState state = randomState(random);
    const PlanarTransform first = randomTransform(random), second = randomTransform(random);
    expectNear(second.after(first).apply(state), second.apply(first.apply(state)), 1e-12);
  }));
}

TEST(Registration, WorksUpsideDown) {
  RigidState a, b;
  b.orientation = Eigen::Quaterniond(0, 1, 0, 0);
  const Registration r = registerState(a, b);
  EXPECT_NEAR(r.angle, 3.14159265358979, 1e-12);
  EXPECT_EQ(r.transform.halfCosine, 1);
  EXPECT_EQ(r.transform.halfSine, 0);
}

}  // namespace
}  // namespace ifa
