// SPDX-License-Identifier: Apache-2.0
// Names of the files that a synchronisation leaves beside the object's.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "ifa/synchronize.h"

namespace ifa {

struct OutputFile {
  const char* name;
  const char* role;                    ///< in the manifest
  std::optional<OutputFormat> format;  ///< none: written whatever is asked for
};

inline constexpr std::array<OutputFile, 8> kOutputFiles = {{
    {"motion.json", "motion", OutputFormat::kJson},
    {"motion.glb", "animation", OutputFormat::kGlb},
    {"motion.usda", "animation", OutputFormat::kUsda},
    {"motion.mp4", "film", OutputFormat::kMp4},
    {"motion.csv", "trajectory", OutputFormat::kCsv},
    {"contacts.csv", "contacts", OutputFormat::kCsv},
    {"timeline.svg", "timeline", {}},
    {"sound.wav", "sound", {}},
}};

/// What the file of this name is; what is not named here belongs to the object.
[[nodiscard]] constexpr std::string_view roleOf(std::string_view name) {
  for (const OutputFile& file : kOutputFiles) {
    if (name == file.name) return file.role;
  }
  return "object";
}

}  // namespace ifa
