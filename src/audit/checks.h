// SPDX-License-Identifier: Apache-2.0
// The checks of the audit, grouped by what they look at. Each appends its checks in a fixed order.
#pragma once

#include <vector>

#include "audit/evidence.h"

namespace ifa::audit_detail {

using Checks = std::vector<AuditCheck>;

/// "samples": finite, in order, unit quaternions, close enough to each other, one at the start and
/// end of each event, one pose per time; "orientation signs": neighbouring quaternions on the same
/// side.
void checkSamples(const Motion& motion, Checks& checks);

/// Whether there is anything to look at: contacts, and finite samples in order of time. The other
/// checks need it.
[[nodiscard]] bool canBeJudged(const Motion& motion);

/// "object": its mass and surface; "contact starts" against targets; "contacts found" in the
/// trajectory; "unlisted contacts".
void checkContacts(const Evidence& all, Checks& checks);

/// "flight position", "flight angle", "flight velocity", "angular momentum".
void checkFlight(const Evidence& all, Checks& checks);

/// "touching on the ground", "friction cone", "motion in contact": steps of silent contact, and the
/// last in events too.
void checkTouching(const Evidence& all, Checks& checks);

/// "event energy", "transient energy", "silent energy".
void checkEnergy(const Evidence& all, Checks& checks);

/// "lowest vertex", between samples too.
void checkGround(const Evidence& all, Checks& checks);

/// "rest pose", "rest speed", "rest support"; nothing where the last event is not terminal.
void checkRest(const Evidence& all, Checks& checks);

/// "orientation as asked": the body's directions where they were asked for; nothing where none was.
void checkOrientations(const Evidence& all, Checks& checks);

/// "bend": the larger of the stated one and the one found from changes and trajectory; "bend
/// understated": by how much the stated one is smaller.
void checkBend(const Evidence& all, Checks& checks);

}  // namespace ifa::audit_detail
