// SPDX-License-Identifier: Apache-2.0
// An ensemble read back from the folder that it was written to.
#pragma once

#include <filesystem>
#include <vector>

#include "audit/separation.h"
#include "ensemble/ensemble_file.h"
#include "pipeline/motion_folder.h"

namespace ifa {

inline constexpr const char* kEnsembleName = "ensemble.json";

struct EnsembleFolder {
  std::filesystem::path file;  ///< the ensemble.json
  Ensemble ensemble;
  std::vector<MotionFolder> bodies;  ///< as many, in the same order; not yet laid on the floor
};

/// True for an ensemble.json, and for a folder that holds one.
[[nodiscard]] bool isEnsemble(const std::filesystem::path& place);

/// @param place  ensemble.json, or the folder that holds it
/// Errors: those of reading; kBadInput for a motion without samples.
[[nodiscard]] Result<EnsembleFolder> readEnsembleFolder(const std::filesystem::path& place);

/// The sound of the whole; none, with a warning added, where it is not there.
[[nodiscard]] Result<std::optional<Sound>> readEnsembleSound(const EnsembleFolder& folder,
                                                             std::vector<std::string>& warnings);

/// What the audit looks at.
[[nodiscard]] std::vector<LaidMotion> laidMotions(const EnsembleFolder& folder);

}  // namespace ifa
