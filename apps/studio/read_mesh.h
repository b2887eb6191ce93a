// SPDX-License-Identifier: Apache-2.0
// What a person's own mesh is to the page: something to draw, its measures and what is wrong with
// it. Done in a process of its own, since it reads a file from anywhere.
#pragma once

#include <filesystem>

#include "ifa/result.h"

namespace ifa::studio {

/// Writes `folder`/mesh.obj, mesh.mtl and report.json: {"triangles", "vertices", "openEdges",
/// "inconsistentEdges", "degenerateTriangles", "area", "volume", "extent": [x, y, z], "solid"}, all
/// lengths in the mesh file's own unit, whatever that is. Files that the mesh names are not read.
/// Errors: kBadInput where no body can be made of it, with what is wrong and what to do.
[[nodiscard]] Result<void> readMesh(const std::filesystem::path& mesh,
                                    const std::filesystem::path& folder);

}  // namespace ifa::studio
