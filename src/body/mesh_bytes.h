// SPDX-License-Identifier: Apache-2.0
// A mesh, or why there is none, as bytes for another process of ours.
#pragma once

#include <string>
#include <string_view>

#include "body/body.h"
#include "ifa/result.h"

namespace ifa {

[[nodiscard]] std::string meshBytes(const Result<Mesh>& mesh);

/// What meshBytes was given. Errors: that one's, or kBadInput where the bytes are damaged; the
/// triangles are sure to have their vertices and materials.
[[nodiscard]] Result<Mesh> meshFromBytes(std::string_view bytes);

}  // namespace ifa
