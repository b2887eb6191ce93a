// SPDX-License-Identifier: Apache-2.0
// `--object auto`: which object explains a sound best (docs/choosing.md).
#pragma once

#include <string>
#include <vector>

#include "ifa/synchronize.h"

namespace ifa {

/// Best first; those without a motion last.
using ObjectRanking = std::vector<ObjectRank>;

/// The objects that "auto" (the library), or a list with commas, names; empty for one object.
/// Errors: kBadInput when the library cannot be read.
[[nodiscard]] Result<std::vector<std::string>> candidateObjects(const std::string& object);

/// Plans one motion with each of `objects` and ranks them.
/// @param settings  as for synchronize(), but for the object
/// Errors: kBadInput and kUsage as of synchronize(), of the first object; kInterrupted.
[[nodiscard]] Result<ObjectRanking> chooseObject(const SynchronizeSettings& settings,
                                                 const std::vector<std::string>& objects,
                                                 const Progress& progress);

/// Those that explain the sound about as well as the best does: who only hears cannot tell them
/// apart. Empty where none has a motion.
[[nodiscard]] std::vector<std::string> asGoodAsBest(const ObjectRanking& ranking);

}  // namespace ifa
