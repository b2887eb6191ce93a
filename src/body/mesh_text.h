// SPDX-License-Identifier: Apache-2.0
// A mesh as the text of an OBJ file and of the MTL file that goes with it.
#pragma once

#include <string>

#include "body/body.h"

namespace ifa {

/// OBJ text, metres, nine digits; `mtlFile` is named in it when not empty.
[[nodiscard]] std::string objText(const Mesh& mesh, const std::string& mtlFile);

/// MTL text of the mesh's materials (colours as seen on a screen).
[[nodiscard]] std::string mtlText(const Mesh& mesh);

}  // namespace ifa
