// SPDX-License-Identifier: Apache-2.0
// motion.json: a synchronised motion on disk (docs/file-formats.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "ifa/motion.h"
#include "ifa/result.h"

namespace ifa {

/// Largest motion.json that is read, in bytes: hours of motion.
inline constexpr std::size_t kMaxMotionBytes = std::size_t{256} << 20;

/// The motion as JSON text. Numbers have the fewest digits that give back the same double, so the
/// same motion gives the same bytes and reading gives back the same motion. One contact and one row
/// of samples a line.
/// Errors: kInternal, naming the field, when a number is not finite.
[[nodiscard]] Result<std::string> formatMotion(const Motion& motion);

/// Reads what formatMotion writes. Fields that are not known are skipped, `database` may be absent.
/// @param place  named in errors together with the field
/// Errors: kBadInput for text that is no JSON, another format or version, a field that is missing,
/// of the wrong kind or absurd, arrays of different lengths, times that go back, an orientation
/// that is not a unit quaternion.
[[nodiscard]] Result<Motion> parseMotion(std::string_view json, const std::string& place);

/// Atomic. Errors: those of formatMotion; kBadInput when the file cannot be written.
[[nodiscard]] Result<void> writeMotionJson(const std::filesystem::path& path, const Motion& motion);

/// Errors: those of reading and of parseMotion.
[[nodiscard]] Result<Motion> readMotionJson(const std::filesystem::path& path);

}  // namespace ifa
