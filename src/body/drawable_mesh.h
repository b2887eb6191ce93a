// SPDX-License-Identifier: Apache-2.0
// A body's mesh as graphics cards want it: vertices with normals, one list of triangles a material.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "body/body.h"

namespace ifa {

struct DrawableMesh {
  std::vector<std::array<float, 3>> positions;        ///< in the mesh's own frame, m
  std::vector<std::array<float, 3>> normals;          ///< unit, one per position
  std::vector<std::vector<std::uint32_t>> triangles;  ///< per material, three indices each
};

/// Corners share a normal where their faces meet at less than `creaseDegrees`, so that dice come
/// out flat and cups round. Triangles without area are left out. Materials without triangles keep
/// an empty list; a mesh without materials gives one list.
[[nodiscard]] DrawableMesh drawableMesh(const Mesh& mesh, double creaseDegrees);

}  // namespace ifa
