// SPDX-License-Identifier: Apache-2.0
#include "body/mass_properties.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "shapes.h"

namespace ifa {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d boxInertia(double mass, const Vector3d& s) {
  const Vector3d squared = s.cwiseAbs2();
  return Vector3d(squared.y() + squared.z(), squared.x() + squared.z(), squared.x() + squared.y())
             .asDiagonal()
             .toDenseMatrix() *
         (mass / 12);
}

TEST(MassProperties, SolidBoxAwayFromTheOriginAndRotated) {
  const Vector3d size(0.02, 0.05, 0.11), shift(3, -2, 7);
  const Matrix3d rotation = shapes::someRotation();
  const auto p = solidProperties(shapes::moved(shapes::box(size), rotation, shift));
  const double volume = size.prod();
  EXPECT_NEAR(p.mass, volume, 1e-11 * volume);
  EXPECT_LT((p.centre - shift).norm(), 1e-12);
  const Matrix3d expected = rotation * boxInertia(volume, size) * rotation.transpose();
  EXPECT_LT((p.inertia() - expected).norm(), 1e-11 * expected.norm());
}

TEST(MassProperties, SolidTetrahedron) {
  const auto p = solidProperties(shapes::cornerTetrahedron());
  EXPECT_NEAR(p.mass, 1.0 / 6, 1e-15);
  EXPECT_LT((p.centre - Vector3d::Constant(0.25)).norm(), 1e-15);
  // About the corner: integral x^2 = 1/60, integral xy = 1/120.
  const Matrix3d aboutCorner = p.covariance + p.mass * p.centre * p.centre.transpose();
  EXPECT_NEAR(aboutCorner(0, 0), 1.0 / 60, 1e-15);
  EXPECT_NEAR(aboutCorner(0, 1), 1.0 / 120, 1e-15);
}

TEST(MassProperties, SolidSphereInTheLimit) {
  const double r = 0.01, volume = 4.0 / 3 * M_PI * r * r * r;
  const auto p = solidProperties(shapes::sphere(r, 200));
  EXPECT_NEAR(p.mass, volume, 3e-4 * volume);
  const Matrix3d expected = 0.4 * volume * r * r * Matrix3d::Identity();
  EXPECT_LT((p.inertia() - expected).norm(), 1e-3 * expected.norm());
}

TEST(MassProperties, ShellCubeOffCentre) {
  const double a = 0.03;
  const Vector3d shift(0.4, 0.1, -0.2);
  const auto p = shellProperties(shapes::box(Vector3d::Constant(a), shift));
  EXPECT_NEAR(p.mass, 6 * a * a, 1e-15);
  EXPECT_LT((p.centre - shift).norm(), 1e-15);
  // Six plates: m a^2 5/18.
  const Matrix3d expected = 5.0 / 18 * p.mass * a * a * Matrix3d::Identity();
  EXPECT_LT((p.inertia() - expected).norm(), 1e-11 * expected.norm());
}

TEST(MassProperties, InsideOutIsNegative) {
  Mesh mesh = shapes::box({1, 1, 1});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(solidProperties(mesh).mass, -1, 1e-12);
}

TEST(MassProperties, TwoHalvesAreTheWhole) {
  const auto left = solidProperties(shapes::box({1, 2, 3}, {0.5, 0, 0}));
  const auto right = solidProperties(shapes::box({1, 2, 3}, {1.5, 0, 0}));
  const auto whole = scaledMass(solidProperties(shapes::box({2, 2, 3}, {1, 0, 0})), 5);
  const auto both = combined(scaledMass(left, 5), scaledMass(right, 5));
  EXPECT_NEAR(both.mass, whole.mass, 1e-12);
  EXPECT_LT((both.centre - whole.centre).norm(), 1e-14);
  EXPECT_LT((both.covariance - whole.covariance).norm(), 1e-12);
}

void expectDiagonalises(const PrincipalFrame& frame, const Matrix3d& inertia) {
  const Matrix3d& r = frame.bodyFromPrincipal;
  EXPECT_LT((r * r.transpose() - Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(r.determinant(), 1, 1e-12);
  EXPECT_LE(frame.moments[0], frame.moments[1]);
  EXPECT_LE(frame.moments[1], frame.moments[2]);
  const Matrix3d back = r * frame.moments.asDiagonal() * r.transpose();
  EXPECT_LT((back - inertia).norm(), 4e-6 * inertia.norm());
}

TEST(PrincipalFrame, ArbitraryTensors) {
  EXPECT_TRUE(rc::check("a proper rotation, ascending moments", [] {
    const auto number = [](int from, int to) { return *rc::gen::inRange(from, to) / 1000.0; };
    const Vector3d sides(number(1, 3000), number(1, 3000), number(1, 3000));
    const Matrix3d turn =
        Eigen::AngleAxisd(
            number(0, 6283),
            Vector3d(number(-1000, 1000), number(-1000, 1000), number(1, 1000)).normalized())
            .toRotationMatrix();
    const Matrix3d inertia = turn * boxInertia(1, sides) * turn.transpose();
    const PrincipalFrame frame = principalFrame(inertia);
    const Matrix3d& r = frame.bodyFromPrincipal;
    RC_ASSERT((r * r.transpose() - Matrix3d::Identity()).norm() < 1e-10);
    RC_ASSERT(r.determinant() > 0);
    RC_ASSERT(frame.moments[0] <= frame.moments[1] && frame.moments[1] <= frame.moments[2]);
    const Matrix3d back = r * frame.moments.asDiagonal() * r.transpose();
    RC_ASSERT((back - inertia).norm() < 4e-6 * inertia.norm());
  }));
}

TEST(PrincipalFrame, SphereHasTheBodysOwnAxes) {
  Matrix3d noisy = Matrix3d::Identity();
  noisy(0, 1) = noisy(1, 0) = 3e-8;
  noisy(2, 2) = 1 - 4e-8;
  EXPECT_EQ(principalFrame(noisy).bodyFromPrincipal, Matrix3d::Identity());
}

TEST(PrincipalFrame, DiagonalTensorsPermuteTheAxes) {
  const Matrix3d inertia = Vector3d(3, 1, 2).asDiagonal();
  const auto frame = principalFrame(inertia);
  expectDiagonalises(frame, inertia);
  EXPECT_EQ(frame.bodyFromPrincipal.col(0), Vector3d::UnitY());
  EXPECT_EQ(frame.moments, Vector3d(1, 2, 3));
}

TEST(PrincipalFrame, BodiesOfRevolutionKeepOneAxisAndDoNotHangOnNoise) {
  const Matrix3d turn = shapes::someRotation();
  for (const Vector3d& moments : {Vector3d(1, 1, 2), Vector3d(1, 2, 2)}) {
    const Matrix3d inertia = turn * moments.asDiagonal() * turn.transpose();
    const auto frame = principalFrame(inertia);
    expectDiagonalises(frame, inertia);
    Matrix3d noisy = inertia;
    noisy(0, 2) += 1e-9;
    noisy(2, 0) += 1e-9;
    EXPECT_LT((principalFrame(noisy).bodyFromPrincipal - frame.bodyFromPrincipal).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace ifa
