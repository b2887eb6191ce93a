// SPDX-License-Identifier: Apache-2.0
// What `ifa database info` tells of a database.
#pragma once

#include <string>

#include "database/database.h"

namespace ifa::cli {

/// Several lines, without the last newline. Reads some columns whole.
/// @param checked  whether every checksum was found to hold
[[nodiscard]] std::string databaseText(const EventDatabase& database, bool checked);

}  // namespace ifa::cli
