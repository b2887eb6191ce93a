// SPDX-License-Identifier: Apache-2.0
// Another colour for an object that has been copied into a motion's folder.
#pragma once

#include <array>
#include <filesystem>

#include "body/body.h"
#include "ifa/result.h"

namespace ifa {

/// Gives the material that covers most of the body the diffuse colour `colour` (Kd: red, green,
/// blue, 0 to 1), in the MTL files in `folder` and in `body`, so that everything that is made from
/// either has it. Pips, letters and the like keep theirs.
/// Errors: kBadInput where no MTL file in `folder` has that material.
[[nodiscard]] Result<void> colourMaterials(const std::filesystem::path& folder,
                                           const std::array<double, 3>& colour, Body& body);

}  // namespace ifa
