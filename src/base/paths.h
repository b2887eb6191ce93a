// SPDX-License-Identifier: Apache-2.0
// Where the program finds what belongs to it.
#pragma once

#include <filesystem>

namespace ifa {

/// The folder of the object library: `$IFA_OBJECTS` when set, else the one of the installation that
/// the running program belongs to, else the one of the source tree that it was built from.
/// Empty when none of them is there.
[[nodiscard]] std::filesystem::path objectsFolder();

/// Where what can be learnt again is kept: `$XDG_CACHE_HOME/inverse-foley`, else
/// `$HOME/.cache/inverse-foley`. Empty when neither variable is set. Need not exist.
[[nodiscard]] std::filesystem::path cacheFolder();

}  // namespace ifa
