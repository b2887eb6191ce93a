// SPDX-License-Identifier: Apache-2.0
#include "body/new_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/file.h"
#include "body/mesh_text.h"
#include "body/object_file.h"
#include "mesh_files.h"
#include "shapes.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

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
