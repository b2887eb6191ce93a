// SPDX-License-Identifier: Apache-2.0
#include "body/simple_hull.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/parallel.h"
#include "body/convex_hull.h"
#include "body/object_file.h"
#include "mesh_files.h"
#include "shapes.h"

namespace ifa {
namespace {

using Eigen::Vector3d;

double reach(const std::vector<Vector3d>& points, const Vector3d& direction) {
  double most = -HUGE_VAL;
  for (const Vector3d& p : points) most = std::max(most, p.dot(direction));
  return most;
}

// How much further `whole` reaches than `part`, the largest over directions all round.
double largestShortfall(const std::vector<Vector3d>& whole, const std::vector<Vector3d>& part,
                        int directions) {
  double most = 0;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2.0 * i + 1) / directions, r = std::sqrt(1 - z * z);
    const double angle = 2.39996322973 * i;
    const Vector3d direction(r * std::cos(angle), r * std::sin(angle), z);
    most = std::max(most, reach(whole, direction) - reach(part, direction));
  }
  return most;
}

// A flat disc, its axis tilted: two polygons of `sides` corners.
std::vector<Vector3d> disc(double radius, double thickness, int sides) {
  std::vector<Vector3d> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / sides;
    for (const double z : {0.0, thickness}) {
      points.push_back(shapes::someRotation() *
                       Vector3d(radius * std::cos(angle), radius * std::sin(angle), z));
    }
  }
  return points;
}

TEST(SimpleHull, LeavesAHullOfFewCornersAsItIs) {
  const auto corners = shapes::sphere(0.02, 15).vertices;
  ASSERT_LE(corners.size(), kMostHullVertices);
  const auto simple = hullForPhysics(corners);
  ASSERT_TRUE(simple) << simple.error().text();
  EXPECT_EQ(simple->corners, *convexHull(corners));
  EXPECT_EQ(simple->exactCorners, simple->corners.size());
  EXPECT_EQ(simple->deviation, 0);
}

TEST(SimpleHull, DeviationIsTheDistanceOfWhatIsLeftOut) {
  // Each corner of a cube lies the third of a diagonal above its neighbours.
  const auto corners = shapes::box({1, 1, 1}).vertices;
  const auto simple = simplifiedHull(corners, 7);
  ASSERT_TRUE(simple) << simple.error().text();
  EXPECT_EQ(simple->corners.size(), 7U);
  EXPECT_EQ(simple->exactCorners, 8U);
  EXPECT_NEAR(simple->deviation, 1 / std::sqrt(3.0), 1e-12);
}

TEST(SimpleHull, OfASphereIsCloseToItEverywhere) {
  const auto corners = shapes::sphere(0.02, 100).vertices;
  const auto simple = simplifiedHull(corners, kMostHullVertices);
  ASSERT_TRUE(simple) << simple.error().text();
  EXPECT_EQ(simple->corners.size(), kMostHullVertices);
  EXPECT_EQ(simple->exactCorners, corners.size());
  // What is stated is true, and 512 evenly spread corners could do no better than 0.24 %.
  const double shortfall = largestShortfall(corners, simple->corners, 4000);
  EXPECT_LE(shortfall, simple->deviation * (1 + 1e-9));
  EXPECT_GE(shortfall, 0.8 * simple->deviation);
  EXPECT_LT(simple->deviation, 0.004 * 0.04);
}

TEST(SimpleHull, KeepsTheFlatSidesOfAThinDisc) {
  const auto corners = disc(0.03, 0.0005, 800);
  const auto simple = hullForPhysics(corners);
  ASSERT_TRUE(simple) << simple.error().text();
  EXPECT_LE(simple->corners.size(), kMostHullVertices);
  EXPECT_LT(simple->deviation, 1e-5);
  const Vector3d axis = shapes::someRotation().col(2);
  EXPECT_NEAR(reach(simple->corners, axis), 0.0005, 1e-12);
  EXPECT_NEAR(reach(simple->corners, -axis), 0, 1e-12);
}

TEST(SimpleHull, DoesNotHangOnTheNumberOfThreads) {
  const auto corners = shapes::sphere(0.02, 40).vertices;
  setThreadCount(1);
  const auto one = simplifiedHull(corners, 200);
  setThreadCount(0);
  const auto many = simplifiedHull(corners, 200);
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->corners, many->corners);
  EXPECT_EQ(one->deviation, many->deviation);
}

TEST(SimpleHull, RefusesAFlatSet) {
  EXPECT_FALSE(hullForPhysics({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.4, 0}}));
  EXPECT_FALSE(simplifiedHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 3, 0}}, 4));
}

TEST(SimpleHull, OfABodyChangesNothingButTheHull) {
  const Mesh mesh = shapes::moved(shapes::sphere(0.02, 120), Eigen::Matrix3d::Identity(),
                                  Vector3d(0.3, -0.1, 0.05));
  const auto start = std::chrono::steady_clock::now();
  const auto body = makeBodyFromMesh(definition(BodyKind::kSolid, 1000), mesh);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_LT(took.count(), 20) << "57,000 triangles take a fraction of a second";
  EXPECT_EQ(body->mesh.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(body->hull.size(), kMostHullVertices);
  EXPECT_GT(body->exactHullVertices, 28'000U);
  EXPECT_NEAR(largestShortfall(body->mesh.vertices, body->hull, 2000), body->hullDeviation,
              0.3 * body->hullDeviation);
  EXPECT_NEAR(body->radius, 0.02, 1e-9);
  const double mass = 1000 * 4 / 3.0 * 3.14159265 * std::pow(0.02, 3);
  EXPECT_NEAR(body->mass, mass, 1e-3 * mass);
  EXPECT_NEAR(body->principalMoments[0], 0.4 * mass * 0.0004, 2e-3 * 0.4 * mass * 0.0004);
}

}  // namespace
}  // namespace ifa
