// SPDX-License-Identifier: Apache-2.0
// Turns a plan into a motion: flights exact, events replayed by the kernel that planned them.
#pragma once

#include "body/body.h"
#include "ifa/contact_signature.h"
#include "ifa/motion.h"
#include "ifa/result.h"
#include "planner/planner.h"

namespace ifa {

/// Trajectory, contacts and scores of `plan` (docs/method.md 7). Leaves `sound`, `program`, `seed`
/// and `searchSeconds` to the caller.
/// @param preRoll  s of flight before the first contact, cut where an earlier contact would lie
/// Errors: kInternal when a replay does not give the planned state.
[[nodiscard]] Result<Motion> buildMotion(const PlanRequest& request, const Plan& plan,
                                         double preRoll);

}  // namespace ifa
