// SPDX-License-Identifier: Apache-2.0
// Known positions of an evaluation case, for the paper's Table 2 (docs/evaluation.md).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "ifa/motion.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"
#include "pipeline/evaluate.h"

namespace ifa {

/// Where the centre of mass is when contacts begin, seen from above, m.
struct KnownPlaces {
  std::vector<Eigen::Vector2d> positions;
  std::vector<Eigen::Vector2d> labelled;  ///< as a person marked them; else as `positions`
};

/// Reads {"positions": [[x, y], ...], "labelled": [[x, y], ...]}, the latter optional. Errors:
/// kBadInput with the field.
[[nodiscard]] Result<KnownPlaces> readKnownPlaces(const std::filesystem::path& path);

/// One wish for each contact, as labelled.
[[nodiscard]] std::vector<PositionWish> wishesFor(const KnownPlaces& places);

/// @param motion  with a contact for each place
[[nodiscard]] PlaceErrors placeErrors(const KnownPlaces& places, const Motion& motion);

}  // namespace ifa
