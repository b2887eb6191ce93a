// SPDX-License-Identifier: Apache-2.0
// A motion as a USD stage in its text form, with the sound (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>

#include "body/body.h"
#include "export/animation_keys.h"
#include "ifa/motion.h"
#include "ifa/result.h"

namespace ifa {

/// Metres, Z up, 24 time codes a second with code 0 at the sound's first sample. Under the default
/// prim: the body, moved by xformOp:translate and xformOp:orient, with a mesh per material and its
/// UsdPreviewSurface; and, when there is a sound, SpatialAudio that plays it from code 0. The same
/// motion gives the same bytes. Errors: kInternal when the motion has no samples or the mesh no
/// triangles.
[[nodiscard]] Result<std::string> formatUsda(const Motion& motion, const Body& body,
                                             const AnimationSettings& settings = {});

/// Atomic. Errors: those of formatUsda; kBadInput when the file cannot be written.
[[nodiscard]] Result<void> writeUsda(const std::filesystem::path& path, const Motion& motion,
                                     const Body& body, const AnimationSettings& settings = {});

}  // namespace ifa
