// SPDX-License-Identifier: Apache-2.0
// Object files (docs/objects.md): reading, writing, the library of objects, and the way from an
// object file to a body.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/paths.h"  // objectsFolder()
#include "body/body.h"
#include "ifa/result.h"

namespace ifa {

/// Names of the objects in objectsFolder(), in natural order (d6 before d10).
[[nodiscard]] Result<std::vector<std::string>> listObjects();

/// The body that `nameOrPath` means: the path of an object file, or a name in objectsFolder().
[[nodiscard]] Result<Body> loadObject(const std::string& nameOrPath);

/// The path of the object file that `nameOrPath` means. Errors name the objects that there are.
[[nodiscard]] Result<std::filesystem::path> findObjectFile(const std::string& nameOrPath);

/// Reads an object file without its meshes. Every number is checked for presence and range; an
/// error's place is "file: field".
[[nodiscard]] Result<ObjectDefinition> readObjectFile(const std::filesystem::path& path);

/// The same from text. `path` resolves the meshes and names the place in errors.
[[nodiscard]] Result<ObjectDefinition> parseObjectFile(std::string_view text,
                                                       const std::filesystem::path& path);

/// The text of an object file, one field or surface a line; readObjectFile() gives the same back.
[[nodiscard]] std::string objectFileText(const ObjectDefinition& definition);

/// Metres per unit for "m", "cm", "mm" or "in"; 0 for anything else.
[[nodiscard]] double metresPerUnit(std::string_view units);

/// Reads the meshes that the definition names and makes the body.
[[nodiscard]] Result<Body> makeBody(ObjectDefinition definition);

/// Makes a body from a mesh in memory (metres). Physics uses the hull of `hullPoints` (the mesh's
/// frame, m), or of the mesh where that is empty. For a solid the mesh must be closed; one that is
/// inside out is turned.
[[nodiscard]] Result<Body> makeBodyFromMesh(ObjectDefinition definition, Mesh mesh,
                                            const std::vector<Eigen::Vector3d>& hullPoints = {});

}  // namespace ifa
