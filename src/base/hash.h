// SPDX-License-Identifier: Apache-2.0
// A hash that is the same on every machine, for names of stored things and for telling whether they
// still fit. Not for security.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace ifa {

/// FNV-1a, 64 bits.
class Hash {
 public:
  Hash& add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) byte((value >> shift) & 0xff);
    return *this;
  }
  Hash& add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }
  Hash& add(std::string_view text) {
    for (const char c : text) byte(static_cast<unsigned char>(c));
    return add(static_cast<std::uint64_t>(text.size()));
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  void byte(std::uint64_t value) { state_ = (state_ ^ value) * 0x100000001b3ULL; }

  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace ifa
