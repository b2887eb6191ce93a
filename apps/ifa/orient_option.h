// SPDX-License-Identifier: Apache-2.0
// The text of --orient.
#pragma once

#include <string>

#include "ifa/result.h"
#include "ifa/synchronize.h"

namespace ifa {

/// Reads "EVENT:FACE=up|down" or "EVENT:BX,BY,BZ=WX,WY,WZ" (and mixtures of the two), where EVENT
/// is a contact's number from 1 or "last". Errors: kUsage.
[[nodiscard]] Result<OrientationWish> parseOrientation(const std::string& text);

}  // namespace ifa
