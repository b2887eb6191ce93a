// SPDX-License-Identifier: Apache-2.0
// What the user asks of a motion beside its sound, as planners understand it (docs/controls.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "body/body.h"
#include "ifa/contact_signature.h"
#include "ifa/result.h"
#include "ifa/synchronize.h"
#include "planner/planner.h"

namespace ifa {

/// Errors: kUsage for a contact that the sound does not have, for a face that the body does not
/// have, and for directions of no length.
[[nodiscard]] Result<std::vector<PlannedOrientation>> plannedOrientations(
    const std::vector<OrientationWish>& wishes, const Body& body,
    const ContactSignature& signature);

/// A contact as users name it: its number from 1, or `last`, which is 0. None for other text.
[[nodiscard]] std::optional<int> contactNumber(std::string_view text);

/// A line for each: number of the contact from 1 or `last`, x and y in metres, tabs between. Lines
/// that begin with # say nothing. Errors: kBadInput with the line; at most 1 MiB.
[[nodiscard]] Result<std::vector<PositionWish>> readPositions(const std::filesystem::path& path);

/// In order of their contacts. Errors: kUsage for a contact that the sound does not have, or that
/// is asked for twice, and for a place that is no place within a kilometre.
[[nodiscard]] Result<std::vector<PlannedPosition>> plannedPositions(
    std::vector<PositionWish> wishes, const ContactSignature& signature);

}  // namespace ifa
