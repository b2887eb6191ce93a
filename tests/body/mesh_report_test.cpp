// SPDX-License-Identifier: Apache-2.0
#include "body/mesh_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body/object_file.h"
#include "mesh_files.h"
#include "shapes.h"

namespace ifa {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::string messages(const MeshReport& report) {
  std::string text;
  for (const auto& problem : report.problems) text += problem.message + "; ";
  return text;
}

TEST(MeshReport, NoVolumeIsTold) {
  Mesh sheet = shapes::box({1, 1, 1e-9});
  EXPECT_THAT(messages(inspectMesh(sheet)), HasSubstr("flat"));
  EXPECT_FALSE(makeBodyFromMesh(definition(BodyKind::kShell, 1), sheet));
  // Both sides of a bent sheet: closed, not flat, nothing inside.
  Mesh bent;
  bent.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  bent.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 2, 3}, {0, 3, 2}};
  const MeshReport report = inspectMesh(bent);
  EXPECT_THAT(messages(report), HasSubstr("encloses no volume"));
  EXPECT_FALSE(report.solid());
  EXPECT_TRUE(report.usable());
  const auto body = makeBodyFromMesh(definition(BodyKind::kSolid, 1), bent);
  ASSERT_FALSE(body);
  EXPECT_THAT(body.error().text(), HasSubstr("encloses no volume"));
}

TEST(MeshReport, OpenMeshIsAShellOnly) {
  Mesh open = shapes::box({0.1, 0.1, 0.1});
  open.triangles.resize(10);
  const MeshReport report = inspectMesh(open);
  EXPECT_EQ(report.openEdges, 4u);
  EXPECT_FALSE(report.solid());
  EXPECT_TRUE(report.usable());
  const auto solid = makeBodyFromMesh(definition(BodyKind::kSolid, 1000), open);
  ASSERT_FALSE(solid);
  EXPECT_THAT(solid.error().text(),
              testing::AllOf(HasSubstr("not closed: 4 open edges"), HasSubstr("--shell")));
  const auto shell = makeBodyFromMesh(definition(BodyKind::kShell, 2), open);
  ASSERT_TRUE(shell) << shell.error().text();
  EXPECT_NEAR(shell->mass, 2 * 5 * 0.01, 1e-12);
  EXPECT_EQ(shell->hull.size(), 8u);
}

TEST(MeshReport, FlippedMeshIsTurned) {
  Mesh flipped = shapes::box({0.1, 0.2, 0.3});
  for (auto& t : flipped.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(messages(inspectMesh(flipped)), HasSubstr("flipped"));
  const auto body = makeBodyFromMesh(definition(BodyKind::kSolid, 1000), flipped);
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_NEAR(body->mass, 6, 1e-9);
  EXPECT_GT(inspectMesh(body->mesh).volume, 0);
}

TEST(MeshReport, InconsistentOrientationIsTold) {
  Mesh mixed = shapes::box({0.1, 0.1, 0.1});
  std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
  const MeshReport report = inspectMesh(mixed);
  EXPECT_EQ(report.inconsistentEdges, 3u);
  EXPECT_EQ(report.openEdges, 0u);
  EXPECT_FALSE(makeBodyFromMesh(definition(BodyKind::kSolid, 1), mixed));
}

TEST(MeshReport, DegenerateTrianglesAreCounted) {
  Mesh mesh = shapes::box({1, 1, 1});
  mesh.vertices.push_back((mesh.vertices[0] + mesh.vertices[1]) / 2);
  mesh.triangles.push_back({0, 8, 1});
  EXPECT_EQ(inspectMesh(mesh).degenerateTriangles, 1u);
  EXPECT_THAT(messages(inspectMesh(mesh)), HasSubstr("degenerate"));
}

TEST(MeshReport, MillimetresAreSeen) {
  const Mesh large = shapes::box({16, 16, 16});
  EXPECT_THAT(messages(inspectMesh(large)), HasSubstr("in millimetres by the look of it"));
  const auto body = makeBodyFromMesh(definition(BodyKind::kSolid, 1000), large);
  ASSERT_FALSE(body);
  EXPECT_THAT(body.error().text(), HasSubstr("check the units"));
  EXPECT_THAT(messages(inspectMesh(shapes::box(Vector3d::Constant(1.6e-5)))),
              HasSubstr("in metres by the look of it"));
}

TEST(MeshReport, TooManyTrianglesAreRefused) {
  Mesh mesh = shapes::box({1, 1, 1});
  mesh.triangles.resize(kMaxTriangles + 1, {0, 1, 2});
  EXPECT_THAT(messages(inspectMesh(mesh)), HasSubstr("more than 2000000"));
  EXPECT_FALSE(inspectMesh(mesh).usable());
}

}  // namespace
}  // namespace ifa
