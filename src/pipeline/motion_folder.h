// SPDX-License-Identifier: Apache-2.0
// A motion read back from the folder that it was written to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "body/body.h"
#include "ifa/motion.h"
#include "ifa/result.h"
#include "sound/sound.h"

namespace ifa {

struct MotionFolder {
  std::filesystem::path file;  ///< the motion.json
  Motion motion;
  Body body;
  std::vector<std::string> warnings;  ///< what was not found beside it
};

/// @param place   motion.json, or the folder that holds it
/// @param object  name or file of the object; empty: the copy beside the motion, else the library's
/// Errors: those of reading; kBadInput when the motion names no object that could be looked for.
[[nodiscard]] Result<MotionFolder> readMotionFolder(const std::filesystem::path& place,
                                                    const std::string& object = {});

/// The sound that the motion names, beside it; none, with a warning added, when it names none or it
/// is not there. Errors: those of reading it.
[[nodiscard]] Result<std::optional<Sound>> readSoundBeside(MotionFolder& folder);

}  // namespace ifa
