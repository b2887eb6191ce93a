// SPDX-License-Identifier: Apache-2.0
// A motion as tables for spreadsheets and scripts (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>

#include "ifa/motion.h"
#include "ifa/result.h"

namespace ifa {

/// One row per sample: time (s after the first contact), sound_time (s in the sound's file), centre
/// of mass (m), orientation w, x, y, z (world from body), velocity (m/s), angular velocity (rad/s,
/// world frame). Numbers read back to the same bits.
[[nodiscard]] std::string formatPoses(const Motion& motion);
/// One row per contact: numbers from 1, times as above, what was heard beside what is asked,
/// factors, bend, place of the centre of mass.
[[nodiscard]] std::string formatContacts(const Motion& motion);

/// `motion.csv` and `contacts.csv` in `folder`, each atomic. Errors: kBadInput when one cannot be
/// written.
[[nodiscard]] Result<void> writeCsv(const std::filesystem::path& folder, const Motion& motion);

}  // namespace ifa
