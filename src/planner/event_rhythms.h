// SPDX-License-Identifier: Apache-2.0
// Events of a database that fit a contact of a signature together with what follows them: the
// look-ahead of the hybrid planner (docs/hybrid.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "database/database.h"
#include "ifa/contact_signature.h"

namespace ifa {

/// An event, and how badly its own rhythm fits.
struct RhythmMatch {
  std::uint32_t event = 0;
  double cost = 0;  ///< log units, 0 is perfect
};

/// The `count` events that meet the signature's event `level` and go on, as simulated, most like
/// the rest of it: gaps and amplitudes of the next few contacts, the end where it is near. Best
/// first, equal ones by event. Terminal events are there for a terminal last contact only, and then
/// only they.
[[nodiscard]] std::vector<RhythmMatch> eventsInRhythm(const EventDatabase& database,
                                                      const ContactSignature& signature,
                                                      std::size_t level, std::size_t count);

}  // namespace ifa
