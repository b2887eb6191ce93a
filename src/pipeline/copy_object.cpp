// SPDX-License-Identifier: Apache-2.0
#include "pipeline/copy_object.h"

#include <cstddef>
#include <sstream>
#include <string>

#include "base/file.h"
#include "body/object_file.h"

namespace ifa {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{1} << 30;

std::string plainName(const std::string& path) { return fs::path(path).filename().string(); }

// Materials of an OBJ lie in files beside it; a missing one only costs the colours.
Result<void> copyMaterials(const fs::path& mesh, const std::string& text, const fs::path& folder) {
  if (mesh.extension() != ".obj" && mesh.extension() != ".OBJ") return {};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("mtllib ", 0) != 0) continue;
    const std::string name = line.substr(7, line.find_last_not_of(" \t\r") - 6);
    // A mesh from elsewhere must not make us read or write outside of its folder.
    if (name.empty() || name != plainName(name)) continue;
    if (auto bytes = readFile(mesh.parent_path() / name, kMaxMeshBytes)) {
      if (auto written = writeFileAtomically(folder / name, *bytes); !written) return written;
    }
  }
  return {};
}

Result<void> copyMesh(const std::string& from, const std::string& name, const fs::path& folder) {
  const auto bytes = readFile(from, kMaxMeshBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  if (auto written = writeFileAtomically(folder / name, *bytes); !written) return written;
  return copyMaterials(from, *bytes, folder);
}

}  // namespace

std::string copiedMeshName(const ObjectDefinition& object) { return plainName(object.meshPath); }

Result<void> copyObject(const ObjectDefinition& object, const fs::path& folder) {
  ObjectDefinition copy = object;
  const auto take = [&folder](const std::string& path, std::string& name) -> Result<void> {
    name = plainName(path);
    return copyMesh(path, name, folder);
  };
  if (auto taken = take(object.meshPath, copy.meshFile); !taken) return taken;
  if (!object.hullPath.empty()) {
    if (auto taken = take(object.hullPath, copy.hullFile); !taken) return taken;
  }
  for (ObjectPart& part : copy.parts) {
    if (auto taken = take(part.meshPath, part.meshFile); !taken) return taken;
  }
  return writeFileAtomically(folder / (object.name + ".json"), objectFileText(copy));
}

}  // namespace ifa
