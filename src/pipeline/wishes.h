// SPDX-License-Identifier: Apache-2.0
// What the user asks of a motion beside its sound, as planners understand it (docs/controls.md).
#pragma once

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

}  // namespace ifa
