// SPDX-License-Identifier: Apache-2.0
// `--object auto`: which object explains a sound best (docs/choosing.md).
#pragma once

#include <string>
#include <vector>

#include "ifa/synchronize.h"

namespace ifa {

/// Likeliest first of those with a motion, then those without.
using ObjectRanking = std::vector<ObjectRank>;

/// The objects that "auto" (the library), or a list with commas, names; empty for one object.
/// Errors: kBadInput when the library cannot be read.
[[nodiscard]] Result<std::vector<std::string>> candidateObjects(const std::string& object);

/// How likely each of several objects is to have made a rhythm, from the logarithms of its density
/// with each (RhythmLikelihood); they sum to 1.
/// @param logs  at least one
[[nodiscard]] std::vector<double> rhythmProbabilities(const std::vector<double>& logs);

/// Weighs `objects` by the rhythm, plans a motion with each of the likeliest, and ranks them by
/// likelihood; with less likely ones too until one has a motion. Objects without the surface or
/// a face that the settings name come last.
/// @param settings  as for synchronize(), but for the object
/// Errors: kBadInput and kUsage as of synchronize(), of the first object, where it is not only that
/// some lack a surface or a face; kInterrupted.
[[nodiscard]] Result<ObjectRanking> chooseObject(const SynchronizeSettings& settings,
                                                 const std::vector<std::string>& objects,
                                                 const Progress& progress);

/// Those that may as well have made the sound as the best: who hears its rhythm only cannot tell
/// them apart. Empty where none has a motion.
[[nodiscard]] std::vector<std::string> asGoodAsBest(const ObjectRanking& ranking);

}  // namespace ifa
