// SPDX-License-Identifier: Apache-2.0
// The object beside its motion, so that the folder of a motion stands alone.
#pragma once

#include <filesystem>

#include "body/body.h"
#include "ifa/result.h"

namespace ifa {

/// Copies all mesh files of the object (with the material files that an OBJ names) into `folder`,
/// under names without a path, and writes NAME.json that names them so.
/// Errors: those of reading and writing.
[[nodiscard]] Result<void> copyObject(const ObjectDefinition& object,
                                      const std::filesystem::path& folder);

/// Name that the visible mesh has there.
[[nodiscard]] std::string copiedMeshName(const ObjectDefinition& object);

}  // namespace ifa
