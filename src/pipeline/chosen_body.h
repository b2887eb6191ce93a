// SPDX-License-Identifier: Apache-2.0
// The body that settings name, as it is planned with.
#pragma once

#include <string>

#include "body/body.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"

namespace ifa {

struct ChosenBody {
  Body body;  ///< with the restitution that the settings ask for
  std::string surface;
};

/// Errors: kBadInput for an object that cannot be read, or that lacks the surface.
[[nodiscard]] Result<ChosenBody> loadChosenBody(const SynchronizeSettings& settings);

}  // namespace ifa
