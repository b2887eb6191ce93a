// SPDX-License-Identifier: Apache-2.0
#include "pipeline/copy_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body/object_file.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::Contains;

TEST(CopyObject, GivesTheSameBodyFromTheCopyAlone) {
  for (const std::string name : {"d6", "CoffeeCup"}) {
    const test::TemporaryFolder folder;
    const Body body = loadObject(name).value();
    ASSERT_TRUE(copyObject(body.definition, folder.path()));
    EXPECT_THAT(folder.names(), Contains(copiedMeshName(body.definition)));
    const Body copy = loadObject((folder / (name + ".json")).string()).value();
    EXPECT_EQ(fs::path(copy.definition.meshPath).parent_path(), folder.path());
    EXPECT_EQ(copy.mass, body.mass);
    EXPECT_EQ(copy.inertia, body.inertia);
    EXPECT_EQ(copy.centreOfMass, body.centreOfMass);
    EXPECT_EQ(copy.hull, body.hull);
    ASSERT_EQ(copy.mesh.materials.size(), body.mesh.materials.size());
    for (std::size_t i = 0; i < body.mesh.materials.size(); ++i) {
      EXPECT_EQ(copy.mesh.materials[i].colour, body.mesh.materials[i].colour);
    }
    const auto& surface = body.definition.surfaces.at(body.definition.defaultSurface);
    const auto& same = copy.definition.surfaces.at(body.definition.defaultSurface);
    EXPECT_EQ(same.restitution, surface.restitution);
    EXPECT_EQ(same.referenceImpulse, surface.referenceImpulse);
  }
}

TEST(CopyObject, DoesNotFollowMaterialsOutOfTheFolderOfTheMesh) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "mesh");
  fs::create_directories(folder / "out/deeper");
  test::writeText(folder / "secret", "x");
  test::writeText(folder / "mesh/m.obj", "mtllib ../secret\nv 0 0 0\n");
  ObjectDefinition object;
  object.name = "thing";
  object.meshPath = folder / "mesh/m.obj";
  ASSERT_TRUE(copyObject(object, folder / "out/deeper"));
  EXPECT_FALSE(fs::exists(folder / "out/secret"));
  EXPECT_TRUE(fs::exists(folder / "out/deeper/m.obj"));
}

TEST(CopyObject, SaysWhichFileIsMissing) {
  const test::TemporaryFolder folder;
  ObjectDefinition object;
  object.name = "thing";
  object.meshPath = folder / "gone.obj";
  const auto result = copyObject(object, folder.path());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().place, folder / "gone.obj");
}

}  // namespace
}  // namespace ifa
