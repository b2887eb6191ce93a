// SPDX-License-Identifier: Apache-2.0
// The script that makes the library: the meshes that it makes are those that are there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "base/file.h"
#include "body/object_file.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

// Objects without lettering, whose outlines take the script seconds: one of each kind of making.
const std::vector<std::string> kQuick = {"Bolt",   "BeerCanCrushed", "FruitBasket",
                                         "Garlic", "Marble",         "MetalCup",
                                         "Nut",    "PaperBall",      "PlasticSpoon"};

TEST(MadeLibrary, ScriptGivesTheSameBytes) {
  const auto script = objectsFolder() / "make_objects.py";
  if (std::system("python3 --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "python3 is not installed";
  }
  const TemporaryFolder folder;
  std::string command = "python3 '" + script.string() + "' '" + folder.path().string() + "'";
  for (const std::string& name : kQuick) command += " " + name;
  ASSERT_EQ(std::system((command + " >/dev/null").c_str()), 0);
  for (const std::string& name : kQuick) {
    for (const char* ending : {".obj", ".mtl"}) {
      const auto made = readFile(folder / (name + ending), 1 << 24);
      const auto kept = readFile(objectsFolder() / (name + ending), 1 << 24);
      ASSERT_TRUE(made && kept) << name;
      EXPECT_TRUE(*made == *kept) << name << ending << " is not what make_objects.py makes";
    }
    const auto definition = readObjectFile(folder / (name + ".json"));
    ASSERT_TRUE(definition) << definition.error().text();
    const auto kept = readObjectFile(objectsFolder() / (name + ".json"));
    ASSERT_TRUE(kept);
    EXPECT_EQ(definition->notes, kept->notes) << name;
    EXPECT_EQ(definition->mass, kept->mass) << name;
    EXPECT_EQ(definition->defaultSurface, kept->defaultSurface) << name;
  }
}

}  // namespace
}  // namespace ifa::test
