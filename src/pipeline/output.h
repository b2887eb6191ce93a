// SPDX-License-Identifier: Apache-2.0
// Last stages of a synchronisation: the files (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "body/body.h"
#include "ifa/synchronize.h"
#include "pipeline/hear.h"

namespace ifa {

/// Sets `motion.sound` to the file that writeTakes writes: the sound as heard, after as much
/// silence as the motion needs to begin at or after its first sample.
void placeInSound(Motion& motion, const Heard& heard);

/// Errors: kUsage, naming the option of the film that is out of range, or that there are no films
/// in this build.
[[nodiscard]] Result<void> checkOutput(const OutputSettings& output);

/// Writes the first take into `folder`, or, when they are `numbered`, each into take-1/, take-2/...
/// of it. A film that is interrupted is left out.
/// @return what the user should know; mostly empty
/// Errors: those of the writers.
[[nodiscard]] Result<std::vector<std::string>> writeTakes(
    const std::filesystem::path& folder, const std::vector<Motion>& takes, bool numbered,
    const Body& body, const Heard& heard, const OutputSettings& output, const Progress& progress);

/// Errors: kUsage when writing to `folder` would replace one of `inputs` or a file of the object.
[[nodiscard]] Result<void> refuseToOverwrite(const std::filesystem::path& folder,
                                             std::vector<std::filesystem::path> inputs,
                                             const ObjectDefinition& object);

/// Names, relative to an output folder, that a run may leave there and a later run replaces.
[[nodiscard]] std::vector<std::filesystem::path> outputNames();

}  // namespace ifa
