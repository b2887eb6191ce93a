// SPDX-License-Identifier: Apache-2.0
// Reads any mesh that assimp reads.
#pragma once

#include <filesystem>
#include <vector>

#include "body/body.h"
#include "ifa/result.h"

namespace ifa {

/// Other files that a mesh file names: its materials, and buffers of glTF.
enum class OtherFiles {
  kRead,
  kIgnored,  ///< for a file of a stranger, which may name any file of this machine
};

/// Reads a mesh file: all its nodes in one mesh, vertices welded (1e-6 of the size), triangles that
/// the welding collapsed left out, materials and colours kept (colours per vertex become one
/// material per colour).
/// @param metresPerUnit  length of the file's unit, m
[[nodiscard]] Result<Mesh> importMesh(const std::filesystem::path& path, double metresPerUnit,
                                      OtherFiles others = OtherFiles::kRead);

/// Joins vertices closer than `tolerance` (m) and drops triangles that collapse.
[[nodiscard]] Mesh weldVertices(const Mesh& mesh, double tolerance);

}  // namespace ifa
