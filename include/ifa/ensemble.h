// SPDX-License-Identifier: Apache-2.0
// Music: several bodies that play one score on one floor (docs/music.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifa/progress.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"

namespace ifa {

/// What is to be played. The defaults are those of `ifa ensemble`.
struct EnsembleSettings {
  std::filesystem::path score;        ///< a score file, or a MIDI file: a body for each channel
  std::string object;                 ///< for a MIDI file; a score file names its own
  std::optional<std::uint64_t> seed;  ///< instead of the score's
  std::string planner = "hybrid";     ///< or "shoot"
};

/// One body and what it plays.
struct EnsemblePlayer {
  std::string name, part;
  Motion motion;      ///< as in its folder, not yet laid on the common floor
  double search = 0;  ///< s, all attempts
};

/// What was found.
struct EnsembleResult {
  std::vector<EnsemblePlayer> players;
  double worstContact = 0;  ///< s between a note and its contact at most
  /// Nearest that two bodies come, m, found by the audit's own method at 1 kHz; none for one body.
  std::optional<double> leastDistance;
  std::string leastOf;       ///< the two bodies
  double leastTime = 0;      ///< s of the sound
  double placing = 0;        ///< s that it took
  bool interrupted = false;  ///< while the film was made; everything else is there
  std::vector<std::string> warnings;

  /// First of the players without an acceptable motion, or null.
  [[nodiscard]] const EnsemblePlayer* failed() const;
};

/// Plans a motion for each body, lays them on one floor, makes their sound, and writes `folder`
/// (docs/file-formats.md): ensemble.json, sound.wav, bodies/NAME/, and as `output` says
/// ensemble.glb and ensemble.mp4. Where a player has no acceptable motion only bodies/ is written,
/// with the partial ones. Files appear only when all is done. Errors: kBadInput for a score or an
/// object that cannot be used; kUsage; kInterrupted; kNoMotion where bodies cannot be laid apart,
/// or the audit finds them too near.
[[nodiscard]] Result<EnsembleResult> performToFolder(const EnsembleSettings& settings,
                                                     const std::filesystem::path& folder,
                                                     const OutputSettings& output,
                                                     const Progress& progress = {});

}  // namespace ifa
