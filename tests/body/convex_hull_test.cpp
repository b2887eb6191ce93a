// SPDX-License-Identifier: Apache-2.0
#include "body/convex_hull.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

#include "shapes.h"

namespace ifa {
namespace {

using Eigen::Vector3d;

// Brute force: a point is a corner when some plane through it and two others has all points on one
// side. Right for points in general position, which is what the tests give it.
std::set<std::size_t> bruteForceCorners(const std::vector<Vector3d>& points) {
  std::set<std::size_t> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Vector3d normal = (points[j] - points[i]).cross(points[k] - points[i]);
        std::size_t above = 0, below = 0;
        for (std::size_t m = 0; m < points.size(); ++m) {
          if (m == i || m == j || m == k) continue;
          (normal.dot(points[m] - points[i]) > 0 ? above : below) += 1;
        }
        if (above == 0 || below == 0) corners.insert({i, j, k});
      }
    }
  }
  return corners;
}

TEST(ConvexHull, AgreesWithBruteForceOnRandomPoints) {
  EXPECT_TRUE(rc::check("same corners", [] {
    const int count = *rc::gen::inRange(5, 25);
    std::vector<Vector3d> points;
    // At full size, or early cases would be made of zeros.
    const auto coordinate =
        rc::gen::resize(rc::kNominalSize, rc::gen::inRange(-1'000'000, 1'000'000));
    for (int i = 0; i < count; ++i) {
      const double x = *coordinate, y = *coordinate, z = *coordinate;
      points.emplace_back(1e-8 * Vector3d(x, y, z));
    }
    const auto hull = convexHull(points, 1e-13);
    RC_ASSERT(hull.has_value());
    std::vector<Vector3d> expected;
    for (const std::size_t i : bruteForceCorners(points)) expected.push_back(points[i]);
    RC_ASSERT(*hull == expected);
  }));
}

TEST(ConvexHull, RandomPointsOnASphereAreAllCorners) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    const double z = 1 - (2.0 * i + 1) / 200, r = std::sqrt(1 - z * z), angle = 2.39996322973 * i;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  auto all = points;
  for (int i = 0; i < 200; ++i) all.push_back(0.9 * points[static_cast<std::size_t>(i)]);
  const auto hull = convexHull(all);
  ASSERT_TRUE(hull);
  EXPECT_EQ(*hull, points) << "in the order given";
}

TEST(ConvexHull, FlatFacesKeepOnlyTrueCorners) {
  std::vector<Vector3d> points;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      for (const double z : {0.0, 1.0}) {
        // A ripple far under the tolerance, as single precision leaves it.
        points.emplace_back(0.1 * i, 0.1 * j, z + 3e-8 * ((i * 7 + j * 3) % 5 - 2));
      }
    }
  }
  const auto hull = convexHull(points);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->size(), 8u);
}

TEST(ConvexHull, TwoCornersNearEachOtherDoNotBothVanish) {
  auto points = shapes::box({1, 1, 1}).vertices;
  points.push_back(points[7] + Vector3d(-1e-7, 2e-8, 1e-8));
  const auto hull = convexHull(points);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->size(), 8u);
  double reach = 0;
  for (const auto& p : *hull) reach = std::max(reach, p.dot(Vector3d(1, 1, 1)));
  EXPECT_NEAR(reach, 1.5, 1e-6);
}

TEST(ConvexHull, DoesNotMindBeingFarFromTheOriginOrSmall) {
  const auto mesh = shapes::box(Vector3d::Constant(1e-3), {1000, -2000, 500});
  const auto hull = convexHull(mesh.vertices);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->size(), 8u);
}

TEST(ConvexHull, RefusesFlatAndBrokenSets) {
  EXPECT_FALSE(convexHull({}));
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.4, 0}}));
  EXPECT_FALSE(convexHull({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, NAN}}));
}

}  // namespace
}  // namespace ifa
