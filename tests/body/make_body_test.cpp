// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "body/mesh_import.h"
#include "body/mesh_report.h"
#include "body/mesh_text.h"
#include "body/object_file.h"
#include "mesh_files.h"
#include "shapes.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

TEST_F(MeshFiles, OneTriangleIsTold) {
  const auto mesh = importMesh(file("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), 1);
  ASSERT_TRUE(mesh);
  for (const BodyKind kind : {BodyKind::kSolid, BodyKind::kShell}) {
    const auto body = makeBodyFromMesh(definition(kind, 1), *mesh);
    ASSERT_FALSE(body);
    EXPECT_THAT(body.error().text(), HasSubstr("only 1 triangle"));
  }
}

TEST_F(MeshFiles, AMillionTrianglesWork) {
  const auto path = file("million.obj", objText(shapes::griddedCube(20, 289), ""));
  const auto start = std::chrono::steady_clock::now();
  const auto mesh = importMesh(path, 0.001);
  ASSERT_TRUE(mesh) << mesh.error().text();
  EXPECT_EQ(mesh->triangles.size(), 1'002'252u);
  const auto body = makeBodyFromMesh(definition(BodyKind::kSolid, 1000), *mesh);
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_NEAR(body->mass, 0.008, 1e-8);
  EXPECT_EQ(body->hull.size(), 8u);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(spent.count()));
  EXPECT_LT(spent.count(), 60);
}

TEST(Body, FrameIsCentredAndPrincipal) {
  const Mesh mesh =
      shapes::moved(shapes::box({0.01, 0.02, 0.04}), shapes::someRotation(), {0.3, -0.1, 0.2});
  const auto body = makeBodyFromMesh(definition(BodyKind::kSolid, 1000), mesh);
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_LT((body->centreOfMass - Vector3d(0.3, -0.1, 0.2)).norm(), 1e-12);
  EXPECT_NEAR(body->radius, Vector3d(0.005, 0.01, 0.02).norm(), 1e-12);
  const double m = 0.008;
  EXPECT_NEAR(body->mass, m, 1e-12);
  EXPECT_LT(
      (body->principalMoments - m / 12 * Vector3d(1e-4 + 4e-4, 1e-4 + 16e-4, 4e-4 + 16e-4)).norm(),
      1e-14);
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& corner : body->hull) sum += corner;
  EXPECT_LT(sum.norm(), 1e-12);
}

TEST_F(MeshFiles, CompositeHasTheMassOfItsParts) {
  file("a.obj", objText(shapes::box({10, 10, 10}, {-5, 0, 0}), ""));
  file("b.obj", objText(shapes::box({10, 10, 10}, {5, 0, 0}), ""));
  file("whole.obj", objText(shapes::box({20, 10, 10}), ""));
  file("thing.json", R"({"format": "inverse-foley-object", "version": 1, "name": "thing",
    "mesh": "whole.obj", "units": "mm", "parts": [
      {"mesh": "a.obj", "kind": "solid", "mass": 0.003},
      {"mesh": "b.obj", "kind": "solid", "density": 1000}],
    "surfaces": {"desk": {"restitution": 0.5, "friction": 0.4}}, "default_surface": "desk"})");
  const auto body = loadObject((folder / "thing.json").string());
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_NEAR(body->mass, 0.004, 1e-9);
  EXPECT_NEAR(body->centreOfMass.x(), (-0.005 * 3 + 0.005) / 4, 1e-9);
  EXPECT_EQ(body->hull.size(), 8u);
}

TEST_F(MeshFiles, AnObjectMayNameItsHull) {
  file("fine.obj", objText(shapes::sphere(10, 12), ""));
  file("hull.obj", objText(shapes::box({20, 20, 20}), ""));
  file("ball.json", R"({"format": "inverse-foley-object", "version": 1, "name": "ball",
    "mesh": "fine.obj", "hull": "hull.obj", "units": "mm", "kind": "solid", "mass": 0.003,
    "surfaces": {"desk": {"restitution": 0.5, "friction": 0.4}}, "default_surface": "desk"})");
  const auto body = loadObject((folder / "ball.json").string());
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_EQ(body->hull.size(), 8u);
}

}  // namespace
}  // namespace ifa
