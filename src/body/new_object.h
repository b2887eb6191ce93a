// SPDX-License-Identifier: Apache-2.0
// From a user's own mesh to an object file.
#pragma once

#include <filesystem>
#include <string>

#include "body/body.h"
#include "ifa/result.h"

namespace ifa {

/// What is asked for.
struct NewObjectRequest {
  std::filesystem::path mesh;    ///< any file that assimp reads
  std::string units;             ///< of that file: m, cm, mm or in
  std::filesystem::path output;  ///< NAME.json; the mesh is written beside it
  BodyKind kind = BodyKind::kSolid;
  double mass = 0;            ///< kg; 0: given by the density
  double density = 0;         ///< kg/m^3 (solid) or kg/m^2 (shell)
  SurfaceProperties surface;  ///< on the surface "desk"
  bool replace = false;       ///< whether files that exist may be overwritten
};

/// Makes the body, then writes NAME.json, NAME.obj and NAME.mtl (NAME-mesh.* where NAME.obj is the
/// mesh that was read). On any error nothing is left of them.
[[nodiscard]] Result<Body> makeObjectFile(const NewObjectRequest& request);

}  // namespace ifa
