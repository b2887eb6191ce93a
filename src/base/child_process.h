// SPDX-License-Identifier: Apache-2.0
// For libraries of others that may crash, hang or end the program over a damaged file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace ifa {

/// Calls `work` in a copy of this process, with its stderr closed, and gives back what it returns.
/// `work` must take no lock that another thread may hold (memory is safe), start no threads, and
/// leave nothing open. The copy dies with this process.
/// @param seconds  of processor time after which it is ended, > 0
/// @param bytes  of memory that it gets beside what this process has; asking for more fails there
/// @return nothing where the copy crashed, threw, was ended, or could not be made
[[nodiscard]] std::optional<std::string> callInChild(const std::function<std::string()>& work,
                                                     double seconds,
                                                     std::uint64_t bytes = std::uint64_t{4} << 30);

}  // namespace ifa
