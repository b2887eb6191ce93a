// SPDX-License-Identifier: Apache-2.0
// Whether a motion that lies in a folder is the one that is asked for now.
#pragma once

#include <string>

#include "ifa/synchronize.h"

namespace ifa {

/// Of all that decides what a motion looks like and how it is filmed, but for which sound it is,
/// the contents of files (who looks at those compares their times) and the list of files wanted.
/// @return 16 hexadecimal digits, the same on every machine; another number with other versions
[[nodiscard]] std::string hashOf(const SynchronizeSettings& settings, const OutputSettings& output);

}  // namespace ifa
