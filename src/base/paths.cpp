// SPDX-License-Identifier: Apache-2.0
#include "base/paths.h"

#include <cstdlib>
#include <system_error>

namespace ifa {

namespace {

bool isFolder(const std::filesystem::path& path) {
  std::error_code code;
  return std::filesystem::is_directory(path, code);
}

// PREFIX/bin/ifa -> PREFIX/share/inverse-foley/objects.
std::filesystem::path installedObjects() {
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code);
  if (code) return {};
  return program.parent_path().parent_path() / IFA_INSTALL_OBJECTS;
}

}  // namespace

std::filesystem::path objectsFolder() {
  if (const char* chosen = std::getenv("IFA_OBJECTS"); chosen != nullptr && *chosen != '\0') {
    return chosen;
  }
  for (const auto& folder : {installedObjects(), std::filesystem::path(IFA_SOURCE_OBJECTS)}) {
    if (isFolder(folder)) return folder;
  }
  return {};
}

}  // namespace ifa
