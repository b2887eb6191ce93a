// SPDX-License-Identifier: Apache-2.0
// The program's version, as CMake knows it.
#pragma once

#include <string_view>

namespace ifa {

/// "major.minor.patch".
[[nodiscard]] std::string_view programVersion();

}  // namespace ifa
