// SPDX-License-Identifier: Apache-2.0
// A motion for one body of an ensemble.
#pragma once

#include <filesystem>
#include <string>

#include "body/body.h"
#include "ensemble/voices.h"
#include "ifa/ensemble.h"

namespace ifa {

/// A body of the ensemble with its motion, which may be a failed one.
struct PlannedVoice {
  EnsemblePlayer player;
  Body body;  ///< with the surface as used
};

/// s of the sound before the score begins, in which the first bodies fall in.
inline constexpr double kEnsembleLead = 0.5;

/// Name of the signature that a body plays, in its folder.
inline constexpr const char* kNotesName = "notes.signature.json";

/// Writes the notes of `voice` into `folder` and looks for a motion of its part's object: one that
/// hops along a line, in hops as short as can be (places asked for at every contact); where there
/// is none, one that goes where it likes, and of several such the one that covers the least floor.
/// Where it is to rest at the end and does not, all that again with a third of the restitution.
/// Errors: those of synchronize(). That nothing acceptable is found is none.
[[nodiscard]] Result<PlannedVoice> planVoice(const Voice& voice, const ScorePart& part,
                                             std::uint64_t seed, const std::string& planner,
                                             const std::filesystem::path& folder,
                                             const Progress& progress);

/// The settings with which `part` is planned, without a sound.
[[nodiscard]] SynchronizeSettings settingsOf(const ScorePart& part, std::uint64_t seed,
                                             const std::string& planner);

}  // namespace ifa
