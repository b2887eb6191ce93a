// SPDX-License-Identifier: Apache-2.0
// For targets that read files: a folder of the process's own, and a check that aborts.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "support/temporary_folder.h"

namespace ifa::fuzz {

/// Gone when the process ends well.
inline const test::TemporaryFolder& scratch() {
  static const test::TemporaryFolder folder;
  return folder;
}

/// A file of that name with these bytes.
inline std::filesystem::path scratchFile(const std::string& name, std::string_view bytes) {
  test::writeText(scratch() / name, std::string(bytes));
  return scratch() / name;
}

inline void require(bool promise) {
  if (!promise) std::abort();
}

}  // namespace ifa::fuzz
