// SPDX-License-Identifier: Apache-2.0
// `ifa sync FOLDER`: one synchronisation after the other, whatever happens to each.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "ifa/synchronize.h"

namespace ifa {

/// One sound of a folder.
struct BatchItem {
  std::string name;  ///< of its output folder
  std::filesystem::path sound;
  std::filesystem::path labels;  ///< the .txt, .csv or .mid beside it; empty: its own cues, or none
};

enum class BatchOutcome { kSolved, kSkipped, kFailed };

/// What became of it.
struct BatchResult {
  BatchItem item;
  BatchOutcome outcome = BatchOutcome::kFailed;
  std::string message;  ///< why it failed; else one line about the motion
};

/// Sounds, MIDI files and signatures in `folder`, not deeper, in order of name; a MIDI file beside
/// a sound of the same stem is that one's labels. Two with the same stem keep their whole names.
/// Errors: kBadInput when there is none.
[[nodiscard]] Result<std::vector<BatchItem>> findSounds(const std::filesystem::path& folder);

/// Synchronises every sound of `sounds` into FOLDER/NAME. One that was solved before with the same
/// object, seed and program, from files that are not newer, is skipped. Stops early when asked to.
/// @param tell  called after each
[[nodiscard]] std::vector<BatchResult> synchronizeAll(
    const std::vector<BatchItem>& sounds, const SynchronizeSettings& settings,
    const std::filesystem::path& folder, const OutputSettings& output, const Progress& progress,
    const std::function<void(const BatchResult&)>& tell);

/// "12 contacts, score 0.91, bend 0.3 (at most 1.1)".
[[nodiscard]] std::string describe(const Motion& motion);

}  // namespace ifa
