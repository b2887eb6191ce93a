// SPDX-License-Identifier: Apache-2.0
// What can be refused of a synchronisation before anything is read.
#pragma once

#include "ifa/synchronize.h"

namespace ifa {

/// Errors: kUsage for numbers out of range and settings that do not go together.
[[nodiscard]] Result<void> checkSettings(const SynchronizeSettings& settings);

}  // namespace ifa
