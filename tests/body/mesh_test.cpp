// SPDX-License-Identifier: Apache-2.0
// Meshes from files, good and bad: import, welding, report, bodies and object files made of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "base/file.h"
#include "body/mesh_import.h"
#include "body/mesh_report.h"
#include "body/mesh_text.h"
#include "body/new_object.h"
#include "body/object_file.h"
#include "shapes.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::HasSubstr;

/// A folder of its own for every test, removed afterwards.
class MeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "ifa-mesh-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }

  std::vector<std::string> filesLeft() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  fs::path folder;
};

ObjectDefinition definition(BodyKind kind, double density) {
  ObjectDefinition d;
  d.name = "thing";
  d.kind = kind;
  d.density = density;
  d.surfaces["desk"] = {};
  d.defaultSurface = "desk";
  return d;
}

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

TEST_F(MeshFiles, OneTriangleIsTold) {
  const auto mesh = importMesh(file("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), 1);
  ASSERT_TRUE(mesh);
  for (const BodyKind kind : {BodyKind::kSolid, BodyKind::kShell}) {
    const auto body = makeBodyFromMesh(definition(kind, 1), *mesh);
    ASSERT_FALSE(body);
    EXPECT_THAT(body.error().text(), HasSubstr("only 1 triangle"));
  }
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

TEST(Weld, JoinsWithinTheToleranceAndNotBeyond) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5e-7, -5e-7, 0}, {1, 0, 1e-5}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 3, 1}};
  const Mesh welded = weldVertices(mesh, 1e-6);
  EXPECT_EQ(welded.vertices.size(), 5u);
  EXPECT_EQ(welded.triangles.size(), 2u) << "the third has collapsed";
  EXPECT_EQ(welded.triangles[0][0], welded.triangles[1][0]);
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

NewObjectRequest request(const fs::path& mesh, const fs::path& output) {
  NewObjectRequest r;
  r.mesh = mesh;
  r.units = "mm";
  r.output = output;
  r.density = 1200;
  r.surface = {0.6, 0.4, 0.0002, 0.0002, 0};
  return r;
}

TEST_F(MeshFiles, NewObjectCanBeLoaded) {
  const auto mesh = file("die.obj", objText(shapes::box({16, 16, 16}), ""));
  const auto made = makeObjectFile(request(mesh, folder / "cube.json"));
  ASSERT_TRUE(made) << made.error().text();
  const auto body = loadObject((folder / "cube.json").string());
  ASSERT_TRUE(body) << body.error().text();
  EXPECT_NEAR(body->mass, made->mass, 1e-6 * made->mass);
  EXPECT_NEAR(body->mass, 1200 * std::pow(0.016, 3), 1e-8);
  EXPECT_DOUBLE_EQ(body->definition.surfaces.at("desk").restitution, 0.6);
  // Once more is refused, unless it is asked for.
  auto again = request(mesh, folder / "cube.json");
  EXPECT_THAT(makeObjectFile(again).error().text(), HasSubstr("exists already"));
  again.replace = true;
  EXPECT_TRUE(makeObjectFile(again));
}

TEST_F(MeshFiles, NewObjectDoesNotOverwriteTheMeshItReads) {
  const std::string text = objText(shapes::box({16, 16, 16}), "");
  const auto mesh = file("cube.obj", text);
  ASSERT_TRUE(makeObjectFile(request(mesh, folder / "cube.json")));
  EXPECT_EQ(*readFile(mesh, 1 << 20), text);
  EXPECT_TRUE(loadObject((folder / "cube.json").string()));
}

TEST_F(MeshFiles, FailedNewObjectLeavesNothing) {
  Mesh open = shapes::box({16, 16, 16});
  open.triangles.pop_back();
  const auto mesh = file("open.obj", objText(open, ""));
  EXPECT_FALSE(makeObjectFile(request(mesh, folder / "cube.json")));
  auto absurd =
      request(file("good.obj", objText(shapes::box({16, 16, 16}), "")), folder / "cube.json");
  absurd.density = 1e12;
  EXPECT_THAT(makeObjectFile(absurd).error().text(), HasSubstr("density"));
  absurd.density = 1000;
  absurd.output = folder / "none" / "cube.json";
  EXPECT_THAT(makeObjectFile(absurd).error().text(), HasSubstr("cannot be written"));
  EXPECT_THAT(filesLeft(), testing::UnorderedElementsAre("open.obj", "good.obj"));
}

}  // namespace
}  // namespace ifa
