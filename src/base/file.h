// SPDX-License-Identifier: Apache-2.0
// Reading whole files within bounds, and writing them so that no half-written one is ever seen.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "ifa/result.h"

namespace ifa {

/// The whole file. Errors: kBadInput when it is missing, a folder, unreadable or larger than
/// `maxBytes`.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes);

/// Writes a temporary beside `path`, then renames it. On any error nothing is left and an older
/// file stays.
[[nodiscard]] Result<void> writeFileAtomically(const std::filesystem::path& path,
                                               std::string_view bytes);

}  // namespace ifa
