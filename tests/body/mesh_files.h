// SPDX-License-Identifier: Apache-2.0
// What the tests of meshes and bodies share: a folder for files, and a plain definition.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "body/body.h"

namespace ifa {

/// A folder of its own for every test, removed afterwards.
class MeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "ifa-mesh-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }

  std::vector<std::string> filesLeft() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  std::filesystem::path folder;
};

inline ObjectDefinition definition(BodyKind kind, double density) {
  ObjectDefinition d;
  d.name = "thing";
  d.kind = kind;
  d.density = density;
  d.surfaces["desk"] = {};
  d.defaultSurface = "desk";
  return d;
}

}  // namespace ifa
