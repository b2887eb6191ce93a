// SPDX-License-Identifier: Apache-2.0
// All bytes to a file descriptor, however many calls that takes.
#pragma once

#include <string_view>

namespace ifa {

/// False where the system refuses; `errno` says why. @param file  open for writing
[[nodiscard]] bool writeAll(int file, std::string_view bytes);

}  // namespace ifa
