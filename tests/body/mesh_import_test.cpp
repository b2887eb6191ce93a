// SPDX-License-Identifier: Apache-2.0
#include "body/mesh_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "body/mesh_bytes.h"
#include "body/mesh_report.h"
#include "body/mesh_text.h"
#include "mesh_files.h"
#include "shapes.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::HasSubstr;

std::string messages(const MeshReport& report) {
  std::string text;
  for (const auto& problem : report.problems) text += problem.message + "; ";
  return text;
}

TEST_F(MeshFiles, ObjKeepsGroupsColoursAndUnits) {
  Mesh box = shapes::box({16, 20, 30}, {100, 0, 0});
  box.materials = {{"red", {0.5, 0.1, 0.02, 1}, 0.3, 0}, {"steel", {0.4, 0.4, 0.5, 1}, 0.2, 1}};
  box.triangleMaterial.assign(12, 0);
  for (std::size_t i = 6; i < 12; ++i) box.triangleMaterial[i] = 1;
  file("box.mtl", mtlText(box));
  const auto mesh = importMesh(file("box.obj", objText(box, "box.mtl")), 0.001);
  ASSERT_TRUE(mesh) << mesh.error().text();
  EXPECT_EQ(mesh->vertices.size(), 8u);
  EXPECT_EQ(mesh->triangles.size(), 12u);
  ASSERT_EQ(mesh->materials.size(), 2u);
  for (std::size_t m = 0; m < 2; ++m) {
    const MeshMaterial& read = mesh->materials[m];
    const std::size_t original = read.name.ends_with("steel") ? 1 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(read.colour[c], box.materials[original].colour[c], 1e-3);
    }
    EXPECT_NEAR(read.roughness, box.materials[original].roughness, 0.02);
    EXPECT_NEAR(read.metallic, box.materials[original].metallic, 1e-6);
    EXPECT_EQ(std::count(mesh->triangleMaterial.begin(), mesh->triangleMaterial.end(),
                         static_cast<int>(m)),
              6);
  }
  const MeshReport report = inspectMesh(*mesh);
  EXPECT_TRUE(report.solid()) << messages(report);
  EXPECT_LT((report.extent - Vector3d(0.016, 0.02, 0.03)).norm(), 1e-8);
}

TEST_F(MeshFiles, OtherFilesCanBeIgnored) {
  Mesh box = shapes::box({1, 2, 3});
  box.materials = {{"red", {1, 0, 0, 1}, 0.3, 0}};
  box.triangleMaterial.assign(12, 0);
  file("box.mtl", mtlText(box));
  const fs::path path = file("box.obj", objText(box, "box.mtl"));
  EXPECT_NEAR(importMesh(path, 1)->materials[0].colour[1], 0, 1e-6);
  const auto alone = importMesh(path, 1, OtherFiles::kIgnored);
  ASSERT_TRUE(alone) << alone.error().text();
  EXPECT_EQ(alone->triangles.size(), 12u);
  EXPECT_GT(alone->materials[0].colour[1], 0.1);
}

TEST_F(MeshFiles, StlIsWelded) {
  std::string text = "solid box\n";
  const Mesh box = shapes::box({1, 1, 1});
  for (const auto& t : box.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : t) {
      const Vector3d& p = box.vertices[static_cast<std::size_t>(i)];
      text += "vertex " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
              std::to_string(p.z()) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  const auto mesh = importMesh(file("box.stl", text + "endsolid box\n"), 1);
  ASSERT_TRUE(mesh) << mesh.error().text();
  EXPECT_EQ(mesh->vertices.size(), 8u);
  EXPECT_TRUE(inspectMesh(*mesh).solid());
}

TEST_F(MeshFiles, PlyColoursPerVertexBecomeMaterials) {
  const auto mesh = importMesh(
      file("t.ply",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n0 0 1 255 0 0\n"
           "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"),
      1);
  ASSERT_TRUE(mesh) << mesh.error().text();
  ASSERT_EQ(mesh->materials.size(), 1u);
  EXPECT_NEAR(mesh->materials[0].colour[0], 1, 1e-6);
  EXPECT_NEAR(mesh->materials[0].colour[1], 0, 1e-6);
}

TEST_F(MeshFiles, WhatIsNoMeshIsTold) {
  const auto fault = [](const fs::path& path) {
    const auto mesh = importMesh(path, 1);
    EXPECT_FALSE(mesh) << path;
    return mesh ? std::string() : mesh.error().text();
  };
  EXPECT_THAT(fault(folder / "none.obj"), HasSubstr("none.obj: no such mesh file"));
  EXPECT_THAT(fault(folder), HasSubstr("is not a file"));
  EXPECT_THAT(fault(file("empty.obj", "")), HasSubstr("is empty"));
  const std::string prose = "Dear reader,\nthis is a letter and not a mesh.\nYours, someone\n";
  for (const char* name : {"letter.obj", "letter.stl", "letter.ply", "letter.glb", "letter.txt"}) {
    EXPECT_THAT(fault(file(name, prose)),
                testing::AnyOf(HasSubstr("is not a mesh"), HasSubstr("holds no triangles")));
  }
  EXPECT_THAT(fault(file("nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")),
              HasSubstr("nan.obj"));
}

TEST_F(MeshFiles, WhatAssimpNeverEndsWithIsRefused) {
  // Found by fuzzing: a header whose properties have lost their names.
  const auto damaged = fs::path(IFA_SOURCE_DIR) / "tests/fuzz/corpus/mesh/slow_ply";
  const auto mesh = importMesh(file("a.ply", test::readText(damaged).substr(1)), 1);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(mesh.error().text(), HasSubstr("a.ply: is not a mesh that can be read"));
  EXPECT_FALSE(mesh.error().remedy.empty());
}

TEST(Weld, VerticesAnywhereAreNoHarm) {
  Mesh mesh = shapes::box({1, 1, 1}, {0, 0, 0});
  mesh.vertices.back() = {1e300, -1e300, 0};
  EXPECT_EQ(weldVertices(mesh, 1e-6).vertices.size(), mesh.vertices.size());
}

TEST(MeshBytes, ReadBackTheSame) {
  Mesh box = shapes::box({1, 2, 3}, {0, 0, 0});
  box.materials = {{"red", {0.5, 0.1, 0.02, 1}, 0.3, 0}, {"", {0.4, 0.4, 0.5, 1}, 0.2, 1}};
  box.triangleMaterial.assign(12, 1);
  const std::string bytes = meshBytes(box);
  const auto back = meshFromBytes(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->vertices, box.vertices);
  EXPECT_EQ(back->triangles, box.triangles);
  EXPECT_EQ(back->triangleMaterial, box.triangleMaterial);
  ASSERT_EQ(back->materials.size(), 2u);
  EXPECT_EQ(back->materials[0].name, "red");
  EXPECT_EQ(back->materials[1].colour, box.materials[1].colour);
  const auto error = meshFromBytes(meshBytes(badInput("what", "where", "remedy")));
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().text(), "where: what (remedy)");
}

TEST(MeshBytes, DamagedOnesAreRefused) {
  Mesh box = shapes::box({1, 2, 3}, {0, 0, 0});
  box.materials.emplace_back();
  box.triangleMaterial.assign(12, 0);
  const std::string bytes = meshBytes(box);
  ASSERT_TRUE(meshFromBytes(bytes));
  for (std::size_t cut = 0; cut < bytes.size(); cut += 7) {
    EXPECT_FALSE(meshFromBytes(bytes.substr(0, cut))) << cut;
  }
  box.triangles[3][1] = 8;
  EXPECT_FALSE(meshFromBytes(meshBytes(box)));
  box.triangles[3][1] = 0;
  box.triangleMaterial[5] = 1;
  EXPECT_FALSE(meshFromBytes(meshBytes(box)));
}

TEST(Weld, JoinsWithinTheToleranceAndNotBeyond) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5e-7, -5e-7, 0}, {1, 0, 1e-5}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 3, 1}};
  const Mesh welded = weldVertices(mesh, 1e-6);
  EXPECT_EQ(welded.vertices.size(), 5u);
  EXPECT_EQ(welded.triangles.size(), 2u) << "the third has collapsed";
  EXPECT_EQ(welded.triangles[0][0], welded.triangles[1][0]);
}

}  // namespace
}  // namespace ifa
