// SPDX-License-Identifier: Apache-2.0
#include "base/paths.h"

#include <cstdlib>
#include <system_error>

namespace ifa {

namespace {

/// What an environment variable says; empty when it is not set.
std::filesystem::path pathFrom(const char* variable) {
  const char* value = std::getenv(variable);
  return value == nullptr ? std::filesystem::path() : std::filesystem::path(value);
}

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
  if (const auto chosen = pathFrom("IFA_OBJECTS"); !chosen.empty()) return chosen;
  for (const auto& folder : {installedObjects(), std::filesystem::path(IFA_SOURCE_OBJECTS)}) {
    if (isFolder(folder)) return folder;
  }
  return {};
}

std::filesystem::path cacheFolder() {
  // The XDG specification has relative paths ignored.
  if (const auto base = pathFrom("XDG_CACHE_HOME"); base.is_absolute()) {
    return base / "inverse-foley";
  }
  const auto home = pathFrom("HOME");
  return home.is_absolute() ? home / ".cache" / "inverse-foley" : std::filesystem::path();
}

}  // namespace ifa
