// SPDX-License-Identifier: Apache-2.0
// A motion as binary glTF 2.0 for animation tools (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/body.h"
#include "export/animation_keys.h"
#include "ifa/motion.h"
#include "ifa/result.h"

namespace ifa {

/// The visible mesh with its materials, moved by one node's translation and rotation: metres, Y up,
/// LINEAR keys at `keyRate` and exactly at each contact's start and end, t = 0 at the sound's first
/// sample (the first pose is held until the motion begins), rest pose = first key. Contacts, seed
/// and sound are in the node's `extras`. With `floorAndLight` two more nodes, `floor` and `light`
/// (KHR_lights_punctual). The same motion gives the same bytes.
/// Errors: kInternal when the motion has no samples or the mesh no triangles.
[[nodiscard]] Result<std::string> formatGlb(const Motion& motion, const Body& body,
                                            const AnimationSettings& settings = {});

/// Atomic. Errors: those of formatGlb; kBadInput when the file cannot be written.
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& path, const Motion& motion,
                                    const Body& body, const AnimationSettings& settings = {});

/// One of several bodies in one file.
struct GlbBody {
  const Motion* motion = nullptr;
  const Body* body = nullptr;
  std::string name;  ///< of its node and mesh
};

/// The same for bodies that share a sound, each with a node and all in one animation. One whose
/// motion begins later has the scale 0 until then (a STEP channel of its own).
[[nodiscard]] Result<std::string> formatGlb(const std::vector<GlbBody>& bodies,
                                            const AnimationSettings& settings = {});
[[nodiscard]] Result<void> writeGlb(const std::filesystem::path& path,
                                    const std::vector<GlbBody>& bodies,
                                    const AnimationSettings& settings = {});

}  // namespace ifa
