// SPDX-License-Identifier: Apache-2.0
// The objects of the library: what every other part of the program takes for granted of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.h"
#include "body/mesh_report.h"
#include "body/object_file.h"
#include "library_table.h"

namespace ifa {
namespace {

using test::Expected;

class LibraryObject : public testing::TestWithParam<Expected> {
 protected:
  void SetUp() override {
    auto loaded = loadObject(GetParam().name);
    ASSERT_TRUE(loaded) << loaded.error().text();
    body = std::move(*loaded);
  }
  Body body;
};

TEST_P(LibraryObject, MeshIsClosedOutwardAndOfReasonableSize) {
  const MeshReport report = inspectMesh(body.mesh);
  EXPECT_EQ(report.openEdges, 0u);
  EXPECT_EQ(report.inconsistentEdges, 0u);
  EXPECT_GT(report.volume, 0);
  EXPECT_TRUE(report.problems.empty()) << report.problems.front().message;
  EXPECT_GE(report.triangles, 300u);
  EXPECT_LE(report.triangles, 5000u);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double side = GetParam().size[static_cast<std::size_t>(i)];
    if (side > 0) {
      EXPECT_NEAR(report.extent[i], side, GetParam().tolerance);
    }
  }
}

TEST_P(LibraryObject, MassIsTheOneStatedAndDensityThatOfAMaterial) {
  EXPECT_DOUBLE_EQ(body.mass, GetParam().mass);
  EXPECT_EQ(body.definition.kind, GetParam().kind);
  const MeshReport report = inspectMesh(body.mesh);
  const double density = GetParam().kind == BodyKind::kSolid ? body.mass / report.volume
                                                             : 1000 * body.mass / report.area;
  EXPECT_GT(density, GetParam().lightest);
  EXPECT_LT(density, GetParam().heaviest);
}

TEST_P(LibraryObject, HullIsSmallAndHoldsTheMeshAndItsCentre) {
  EXPECT_GE(body.hull.size(), GetParam().fewest);
  EXPECT_LE(body.hull.size(), GetParam().most);
  // A direction in which the mesh reaches further than the hull would sink into the ground; one in
  // which it falls short by more than 0.05 mm would hover.
  for (int i = 0; i < 500; ++i) {
    const double z = 1 - (2.0 * i + 1) / 500, r = std::sqrt(1 - z * z), angle = 2.39996322973 * i;
    const Eigen::Vector3d direction(r * std::cos(angle), r * std::sin(angle), z);
    double hull = -1, mesh = -1;
    for (const auto& p : body.hull) hull = std::max(hull, p.dot(direction));
    for (const auto& p : body.mesh.vertices) mesh = std::max(mesh, p.dot(direction));
    EXPECT_LE(mesh, hull + 1e-7);
    EXPECT_GE(mesh, hull - 5e-5);
    EXPECT_GT(hull, GetParam().depth) << "the centre of mass is not well inside the hull";
  }
}

TEST_P(LibraryObject, FacesAreUnitDirections) {
  EXPECT_EQ(body.definition.faces.size(), GetParam().faces);
  for (const auto& [name, face] : body.definition.faces) EXPECT_NEAR(face.norm(), 1, 1e-8) << name;
}

TEST_P(LibraryObject, SurfacesColoursAndNotesAreThere) {
  std::vector<std::string> names;
  for (const auto& [name, surface] : body.definition.surfaces) {
    names.push_back(name);
    EXPECT_GT(surface.referenceImpulse, 0) << name << " is not calibrated";
  }
  EXPECT_THAT(names, testing::UnorderedElementsAreArray(GetParam().surfaces));
  EXPECT_THAT(body.definition.surfaces,
              testing::Contains(testing::Key(body.definition.defaultSurface)));
  EXPECT_FALSE(body.definition.notes.empty());
  EXPECT_FALSE(body.definition.material.empty());
  EXPECT_EQ(body.mesh.triangleMaterial.size(), body.mesh.triangles.size());
  for (int material : body.mesh.triangleMaterial) {
    ASSERT_LT(static_cast<std::size_t>(material), body.mesh.materials.size());
  }
}

// So that a calibration changes the lines of its numbers and no others.
TEST_P(LibraryObject, FileIsLaidOutAsTheProgramWritesIt) {
  const auto text = readFile(body.definition.path, 1 << 20);
  ASSERT_TRUE(text);
  const auto definition = readObjectFile(body.definition.path);
  ASSERT_TRUE(definition);
  EXPECT_EQ(objectFileText(*definition), *text);
}

INSTANTIATE_TEST_SUITE_P(Objects, LibraryObject, testing::ValuesIn(test::expectedObjects()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(Library, HoldsEveryRowOfThePapersTable) {
  const auto rows = test::paperTableRows();
  EXPECT_EQ(rows.size(), 31U);
  for (const auto& [name, surface] : rows) {
    const auto path = findObjectFile(name);
    ASSERT_TRUE(path) << path.error().text();
    const auto definition = readObjectFile(*path);
    ASSERT_TRUE(definition) << definition.error().text();
    EXPECT_TRUE(definition->surfaces.contains(surface)) << name << " on " << surface;
    const bool tumbles = name == "Nut" || name == "Bolt";
    EXPECT_DOUBLE_EQ(definition->sampling.coneDegrees, tumbles ? 80 : 30) << name;
    const bool blurred = name == "Nut" || name == "BeerCanCrushed" || name == "Garlic";
    EXPECT_DOUBLE_EQ(definition->mergeGap, blurred ? 0.03 : 0.01) << name;
  }
}

TEST(Library, DiceAreIsotropicAndNumberedAsDiceAre) {
  for (const char* name : {"d4", "d6", "d8", "d12", "d20"}) {
    const auto body = loadObject(name);
    ASSERT_TRUE(body) << body.error().text();
    const Eigen::Vector3d& moments = body->principalMoments;
    EXPECT_LT((moments[2] - moments[0]) / moments[2], 0.01) << name;
  }
  for (const auto& [name, sum] :
       {std::pair{"d6", 7}, {"d8", 9}, {"d10", 9}, {"d12", 13}, {"d20", 21}}) {
    const auto body = loadObject(name);
    ASSERT_TRUE(body);
    for (const auto& [face, direction] : body->definition.faces) {
      const auto& opposite = body->definition.faces.at(std::to_string(sum - std::stoi(face)));
      EXPECT_LT((direction + opposite).norm(), 1e-6) << name << " " << face;
    }
  }
}

// A face named n that points up leaves the die resting on its lowest hull vertices.
TEST(Library, ADieRestsFlatWithEachFaceUp) {
  for (const auto& [name, resting] :
       {std::pair{"d4", 3}, {"d6", 4}, {"d8", 3}, {"d10", 4}, {"d12", 5}, {"d20", 3}}) {
    const auto body = loadObject(name);
    ASSERT_TRUE(body);
    for (const auto& [face, up] : body->definition.faces) {
      double lowest = 1;
      for (const auto& p : body->hull) lowest = std::min(lowest, p.dot(up));
      const auto touching =
          std::count_if(body->hull.begin(), body->hull.end(),
                        [&, &up = up](const auto& p) { return p.dot(up) < lowest + 1e-7; });
      EXPECT_EQ(touching, resting) << name << " " << face;
    }
  }
}

TEST(Library, IsListedInNaturalOrder) {
  const auto names = listObjects();
  ASSERT_TRUE(names) << names.error().text();
  EXPECT_EQ(names->size(), test::expectedObjects().size());
  EXPECT_THAT(*names, testing::IsSupersetOf({"CoffeeCup", "Eraser", "Lego2x2", "Nut", "d4", "d6",
                                             "d8", "d10", "d12", "d20"}));
  const auto at = [&](const char* name) { return std::find(names->begin(), names->end(), name); };
  EXPECT_LT(at("d8"), at("d10"));
}

TEST(Library, FolderFollowsTheVariable) {
  ::setenv("IFA_OBJECTS", "/nonexistent/objects", 1);
  EXPECT_EQ(objectsFolder(), "/nonexistent/objects");
  const auto names = listObjects();
  ::unsetenv("IFA_OBJECTS");
  ASSERT_FALSE(names);
  EXPECT_THAT(names.error().text(), testing::HasSubstr("IFA_OBJECTS"));
  EXPECT_TRUE(std::filesystem::is_directory(objectsFolder()));
}

TEST(Library, UnknownObjectIsToldWithTheKnownOnes) {
  const auto body = loadObject("d7");
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(body.error().text(),
              testing::AllOf(testing::HasSubstr("d7"), testing::HasSubstr("d6, d8, d10")));
  EXPECT_THAT(loadObject("none/d6.json").error().text(), testing::HasSubstr("no such object file"));
}

}  // namespace
}  // namespace ifa
