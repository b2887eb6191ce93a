// SPDX-License-Identifier: Apache-2.0
#include "render/body_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "body/object_file.h"
#include "scenes.h"

namespace ifa::render {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

Body object(const std::string& name) {
  auto body = loadObject(std::string(IFA_SOURCE_DIR) + "/objects/" + name + ".json");
  if (!body) throw std::runtime_error(body.error().text());
  return *body;
}

struct OracleHit {
  double distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::size_t triangle = 0;
  double toEdge = 1;  ///< least barycentric coordinate of any triangle whose plane was met
};

/// Moeller and Trumbore over all triangles, in double precision.
OracleHit oracle(const Mesh& mesh, const Ray& ray) {
  const Eigen::Vector3d o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
  OracleHit best;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = [&](std::size_t k) -> const Eigen::Vector3d& {
      return mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
    };
    const Eigen::Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0), p = d.cross(b);
    const double det = a.dot(p);
    if (std::abs(det) < 1e-15) continue;
    const Eigen::Vector3d s = o - corner(0), q = s.cross(a);
    const double u = s.dot(p) / det, v = d.dot(q) / det, t = b.dot(q) / det;
    if (t <= 0) continue;
    const double least = std::min({u, v, 1 - u - v});
    best.toEdge = std::min(best.toEdge, std::abs(least));
    if (least < 0 || t >= best.distance) continue;
    best.distance = t;
    best.normal = a.cross(b).normalized();
    best.triangle = i;
  }
  return best;
}

/// From somewhere around the body, mostly towards it.
Ray someRay(test::Lottery& lottery, float radius) {
  const Vector origin = lottery.direction() * radius * static_cast<float>(lottery.between(0, 3));
  const Vector target = lottery.direction() * radius * static_cast<float>(lottery.between(0, 1.2));
  return {origin, (target - origin).normalized()};
}

void agrees(const Body& body, int rays) {
  const BodyGeometry geometry(body);
  test::Lottery lottery;
  int hits = 0, misses = 0;
  SurfaceHit hit;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = someRay(lottery, static_cast<float>(body.radius));
    const OracleHit expected = oracle(body.mesh, ray);
    if (expected.toEdge < 1e-4) continue;  // single precision may see it on either side
    const bool found = geometry.intersect(ray, kFar, hit);
    const bool wanted = std::isfinite(expected.distance);
    ASSERT_EQ(found, wanted) << "ray " << i;
    ASSERT_EQ(geometry.occludes(ray), wanted) << "ray " << i;
    ASSERT_EQ(geometry.distance(ray), found ? hit.distance : kFar) << "ray " << i;
    ++(found ? hits : misses);
    if (!found) continue;
    ASSERT_NEAR(hit.distance, expected.distance, 1e-5 * expected.distance + 1e-5 * body.radius);
    const double cosine = std::abs(hit.geometric.cast<double>().dot(expected.normal));
    ASSERT_GT(cosine, 0.999);
    ASSERT_LE(hit.geometric.dot(ray.direction), 0) << "towards where the ray comes from";
    ASSERT_GE(hit.normal.dot(hit.geometric), 0);
    ASSERT_NEAR(hit.normal.norm(), 1, 1e-5);
    const auto material = static_cast<std::size_t>(body.mesh.triangleMaterial[expected.triangle]);
    ASSERT_NEAR(hit.finish->colour[0], body.mesh.materials[material].colour[0], 1e-6);
    // Nothing closer than the limit, where the limit is in front of it.
    ASSERT_FALSE(geometry.intersect(ray, 0.999f * hit.distance, hit));
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_GT(misses, rays / 20);
}

TEST(BodyGeometry, MeetsABoxWhereAllItsTrianglesTested) {
  agrees(test::bodyOf(shapes::box({0.02, 0.03, 0.01})), 4000);
}

TEST(BodyGeometry, MeetsACupWhereAllItsTrianglesTested) { agrees(object("CoffeeCup"), 1500); }

TEST(BodyGeometry, MeetsADieWithItsMaterials) { agrees(object("d6"), 1000); }

TEST(BodyGeometry, LetsNoRayThroughAtEdgesAndCorners) {
  const Mesh box = shapes::box({0.02, 0.02, 0.02});
  const BodyGeometry geometry(test::bodyOf(box));
  test::Lottery lottery;
  SurfaceHit hit;
  for (int i = 0; i < 3000; ++i) {
    // A point on a diagonal of a face, a little inside so that it is no question of outlines.
    const auto& triangle = box.triangles[static_cast<std::size_t>(i) % box.triangles.size()];
    const auto& a = box.vertices[static_cast<std::size_t>(triangle[0])];
    const auto& b = box.vertices[static_cast<std::size_t>(triangle[(i / 12) % 2 == 0 ? 1 : 2])];
    const Vector target = (a + lottery.between(0.01, 0.99) * (b - a)).cast<float>() * 0.9999f;
    const Vector origin = 3 * target + 0.001f * lottery.direction();
    ASSERT_TRUE(geometry.intersect({origin, (target - origin).normalized()}, kFar, hit)) << i;
  }
}

/// Share of the rays that hit where the whole body lies behind the surface. Wherever that is said,
/// no ray from there meets the body again.
double openShare(const Body& body) {
  const BodyGeometry geometry(body);
  test::Lottery lottery;
  SurfaceHit hit;
  int hits = 0, open = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = someRay(lottery, static_cast<float>(body.radius));
    if (!geometry.intersect(ray, kFar, hit)) continue;
    ++hits;
    open += hit.open ? 1 : 0;
    if (!hit.open) continue;
    const auto radius = static_cast<float>(body.radius);
    const Vector place = ray.origin + hit.distance * ray.direction + 1e-3f * radius * hit.geometric;
    const Vector away = (hit.geometric + 0.95f * lottery.direction()).normalized();
    EXPECT_FALSE(geometry.occludes({place, away})) << body.definition.name << ", ray " << i;
  }
  return static_cast<double>(open) / hits;
}

TEST(BodyGeometry, KnowsWhatCannotShadeItself) {
  // Some rays start inside and meet the inner side of a face.
  EXPECT_GT(openShare(test::cubeOf(0.02)), 0.6);
  EXPECT_GT(openShare(test::bodyOf(shapes::sphere(0.01, 12))), 0.6);
  for (const char* name : {"d4", "d6", "d8", "d10", "d12", "d20", "Eraser"}) {
    EXPECT_GT(openShare(object(name)), 0.6) << name;
  }
  for (const char* name : {"CoffeeCup", "Nut", "Lego2x2"}) {
    EXPECT_LT(openShare(object(name)), 0.6) << name;
  }
}

TEST(BodyGeometry, IsFlatOnABoxAndRoundOnABall) {
  SurfaceHit hit;
  const Ray ray{{0.011f, 0.013f, 0.5f}, {0, 0, -1}};
  ASSERT_TRUE(BodyGeometry(test::cubeOf(0.04)).intersect(ray, kFar, hit));
  EXPECT_LT((hit.normal - Vector::UnitZ()).norm(), 1e-5f);
  ASSERT_TRUE(BodyGeometry(test::bodyOf(shapes::sphere(0.02, 16))).intersect(ray, kFar, hit));
  const Vector place = ray.origin + hit.distance * ray.direction;
  EXPECT_LT((hit.normal - place.normalized()).norm(), 0.03f);
  EXPECT_LT(hit.geometric.dot(hit.normal), 0.99999f) << "facets below";
}

TEST(BodyGeometry, KnowsItsSize) {
  EXPECT_NEAR(BodyGeometry(test::cubeOf(0.02)).radius(), 0.01 * std::sqrt(3.0), 1e-6);
  const Body cup = object("CoffeeCup");
  EXPECT_NEAR(BodyGeometry(cup).radius(), cup.radius, 1e-5);
}

TEST(BodyGeometry, TakesAMeshWithoutMaterials) {
  Body body = test::cubeOf(0.02);
  body.mesh.materials.clear();
  body.mesh.triangleMaterial.clear();
  const BodyGeometry geometry(body);
  SurfaceHit hit;
  ASSERT_TRUE(geometry.intersect({{0, 0, 1}, {0, 0, -1}}, kFar, hit));
  EXPECT_NEAR(hit.finish->colour[1], 0.8, 1e-6);
}

}  // namespace
}  // namespace ifa::render
