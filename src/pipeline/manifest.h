// SPDX-License-Identifier: Apache-2.0
// The list of what was written, for programs that go on from there (docs/file-formats.md).
#pragma once

#include <filesystem>

#include "ifa/motion.h"
#include "ifa/result.h"

namespace ifa {

/// Writes `manifest.json` in `folder`: its files by name, with their sizes and what they are, and
/// what the motion in them is. Errors: kBadInput when it cannot be written.
[[nodiscard]] Result<void> writeManifest(const std::filesystem::path& folder, const Motion& motion);

}  // namespace ifa
