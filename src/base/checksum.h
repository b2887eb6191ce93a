// SPDX-License-Identifier: Apache-2.0
// A fast checksum for large files. Not for security.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ifa {

/// XXH64 with seed 0 (Yann Collet's xxHash; the same as `xxh64sum`), taken piece by piece. The
/// value does not depend on where the pieces were cut.
class Checksum {
 public:
  Checksum& add(std::span<const std::byte> bytes);
  /// Of all that was added so far.
  [[nodiscard]] std::uint64_t value() const;

 private:
  static constexpr std::size_t kStripe = 32;

  void stripe(const std::byte* bytes);
  [[nodiscard]] std::uint64_t mixedLanes() const;

  std::array<std::uint64_t, 4> lanes_ = {0x60EA27EEADC0B5D6ULL, 0xC2B2AE3D27D4EB4FULL, 0,
                                         0x61C8864E7A143579ULL};
  std::array<std::byte, kStripe> rest_{};  ///< what is left over a whole stripe
  std::size_t restBytes_ = 0;
  std::uint64_t total_ = 0;  ///< bytes
};

}  // namespace ifa
