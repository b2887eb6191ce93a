// SPDX-License-Identifier: Apache-2.0
#include "connection/placement.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "base/random.h"
#include "body/object_file.h"
#include "body/symmetry.h"
#include "dynamics/stepper.h"

namespace ifa::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Matrix3d kMirror = Vector3d(1, -1, 1).asDiagonal();

Vector3d randomVector(RandomStream& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

RigidState randomState(RandomStream& random) {
  RigidState state;
  state.position = randomVector(random, 0.3);
  state.position.z() = 0.05;
  state.orientation = Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1),
                                         random.uniform(-1, 1), random.uniform(-1, 1))
                          .normalized();
  state.velocity = randomVector(random, 1);
  state.velocity.z() = -1.5;
  state.angularVelocity = randomVector(random, 20);
  return state;
}

Body library(const char* name) { return loadObject(name).value(); }

void expectNear(const RigidState& a, const RigidState& b, double slack) {
  EXPECT_LT((a.position - b.position).norm(), slack);
  EXPECT_LT((a.velocity - b.velocity).norm(), slack);
  EXPECT_LT((a.angularVelocity - b.angularVelocity).norm(), 100 * slack);
  EXPECT_LT((a.orientation.toRotationMatrix() - b.orientation.toRotationMatrix()).norm(),
            10 * slack);
}

/// By matrices: R S, or M R S and its velocities in the mirror.
TEST(SymmetryImage, IsWhatMatricesMakeOfAState) {
  RandomStream random(1, 1);
  const SymmetryGroup group = findSymmetry(library("d4"));
  for (const Matrix3d& element : group.elements()) {
    const RigidState state = randomState(random);
    const RigidState seen = SymmetryImage::of(element).apply(state);
    const bool improper = element.determinant() < 0;
    const Matrix3d world = improper ? kMirror : Matrix3d(Matrix3d::Identity());
    const Matrix3d turned = world * state.orientation.toRotationMatrix() * element;
    EXPECT_LT((seen.orientation.toRotationMatrix() - turned).norm(), 1e-14);
    EXPECT_LT((seen.position - world * state.position).norm(), 1e-15);
    EXPECT_LT((seen.velocity - world * state.velocity).norm(), 1e-15);
    const Vector3d spin = world.determinant() * world * state.angularVelocity;
    EXPECT_LT((seen.angularVelocity - spin).norm(), 1e-14);
  }
}

TEST(SymmetryImage, TheIdentityChangesNoBit) {
  RandomStream random(1, 2);
  const RigidState state = randomState(random);
  const RigidState seen = SymmetryImage::of(Matrix3d::Identity()).apply(state);
  EXPECT_EQ(seen.position, state.position);
  EXPECT_EQ(seen.orientation.coeffs(), state.orientation.coeffs());
  EXPECT_EQ(seen.velocity, state.velocity);
  EXPECT_EQ(seen.angularVelocity, state.angularVelocity);
}

TEST(SymmetryImage, TheBodyFillsTheSamePlace) {
  RandomStream random(1, 3);
  for (const char* name : {"d10", "Nut", "CoffeeCup"}) {
    const Body body = library(name);
    const SymmetryGroup group = findSymmetry(body);
    for (const Matrix3d& element : group.elements()) {
      const RigidState state = randomState(random);
      const SymmetryImage image = SymmetryImage::of(element);
      const RigidState seen = image.apply(state);
      for (const Vector3d& corner : body.hull) {
        const Vector3d local = body.bodyFromPrincipal.transpose() * corner;
        const Vector3d there = image.direction(state.position + state.orientation * local);
        double nearest = 1;
        for (const Vector3d& other : body.hull) {
          const Vector3d q = body.bodyFromPrincipal.transpose() * other;
          nearest = std::min(nearest, (seen.position + seen.orientation * q - there).norm());
        }
        EXPECT_LT(nearest, 1e-4 * body.radius) << name;
      }
    }
  }
}

/// Flight and first impact of an image are the image of flight and first impact; where corners hit
/// together, but for the order in which the solver takes them.
TEST(SymmetryImage, PhysicsDoesNotTellImagesApart) {
  RandomStream random(1, 4);
  double alike = 0, all = 0;
  for (const char* name : {"d4", "d6", "d10", "Nut", "Lego2x2", "CoffeeCup"}) {
    const Body body = library(name);
    const BodyModel model(body, body.definition.surfaces.at(body.definition.defaultSurface));
    const auto untilImpact = [&](const RigidState& start) {
      Stepper stepper(model);
      stepper.start(kernelState(start, 0));
      for (int i = 0; i < 1000 && stepper.advance(1) != Advance::kImpact; ++i) {
      }
      return stepper.state();
    };
    const SymmetryGroup group = findSymmetry(body);
    for (const Matrix3d& element : group.elements()) {
      RigidState state = randomState(random);
      state.position.z() = 1.5 * body.radius;
      const SymmetryImage image = SymmetryImage::of(element);
      const KernelState<double> own = untilImpact(state), seen = untilImpact(image.apply(state));
      const RigidState expected = image.apply(rigidState(own)), there = rigidState(seen);
      // The cup's hull is its mirror image to 1e-5 only.
      EXPECT_NEAR(own.time, seen.time, 1e-6) << name;
      EXPECT_LT((expected.position - there.position).norm(), 1e-6) << name;
      EXPECT_LT(expected.orientation.angularDistance(there.orientation), 1e-5) << name;
      alike += (expected.velocity - there.velocity).norm() < 1e-5 &&
               (expected.angularVelocity - there.angularVelocity).norm() < 1e-3;
      ++all;
    }
  }
  EXPECT_GT(alike, 0.9 * all);
}

TEST(Placement, OneAfterAnother) {
  RandomStream random(1, 5);
  const SymmetryGroup group = findSymmetry(library("d6"));
  const auto some = [&] {
    const double half = random.uniform(-3, 3);
    return Placement{{std::cos(half), std::sin(half), random.uniform(-1, 1), random.uniform(-1, 1)},
                     SymmetryImage::of(group.elements()[random.below(group.order())])};
  };
  for (int i = 0; i < 100; ++i) {
    const Placement a = some(), b = some();
    const RigidState state = randomState(random);
    expectNear(a.after(b).apply(state), a.apply(b.apply(state)), 1e-13);
    EXPECT_LT((a.directionFrom(a.direction(state.velocity)) - state.velocity).norm(), 1e-14);
    EXPECT_LT((a.axialFrom(a.axial(state.angularVelocity)) - state.angularVelocity).norm(), 1e-13);
    EXPECT_LT((a.apply(state).velocity - a.direction(state.velocity)).norm(), 1e-14);
    EXPECT_LT((a.apply(state).angularVelocity - a.axial(state.angularVelocity)).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace ifa::test
