// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: the same draw for the same key, whoever asks and in whatever order.
#pragma once

#include <array>
#include <cstdint>

namespace ifa {

/// Philox4x32-10 (Salmon et al. 2011): four 32-bit words for a 128-bit counter and a 64-bit key.
inline std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                               std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t product1 = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product0)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

/// A stream of draws keyed by (seed, stream). Streams with different keys are independent.
/// Not thread safe; cheap to make, so make one per item of work.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

  /// Next 64 random bits.
  std::uint64_t bits() {
    if (used_ == 2) refill();
    const auto low = words_[2 * used_], high = words_[2 * used_ + 1];
    ++used_;
    return (std::uint64_t{high} << 32) | low;
  }
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, count), count > 0 (bias under 2^-32 for count < 2^32).
  std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>(static_cast<double>(count) * uniform());
  }

 private:
  void refill() {
    words_ =
        philox4x32({static_cast<std::uint32_t>(block_), static_cast<std::uint32_t>(block_ >> 32),
                    static_cast<std::uint32_t>(stream_), static_cast<std::uint32_t>(stream_ >> 32)},
                   {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
    ++block_;
    used_ = 0;
  }

  std::uint64_t seed_, stream_, block_ = 0;
  std::array<std::uint32_t, 4> words_{};
  unsigned used_ = 2;
};

}  // namespace ifa
