// SPDX-License-Identifier: Apache-2.0
#include "base/checksum.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ifa {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint64_t kPrime1 = 0x9E3779B185EBCA87ULL, kPrime2 = 0xC2B2AE3D27D4EB4FULL,
                        kPrime3 = 0x165667B19E3779F9ULL, kPrime4 = 0x85EBCA77C2B2AE63ULL,
                        kPrime5 = 0x27D4EB2F165667C5ULL;

template <class Word>
Word read(const std::byte* bytes) {
  Word word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

std::uint64_t turned(std::uint64_t lane, std::uint64_t word) {
  return std::rotl(lane + word * kPrime2, 31) * kPrime1;
}

std::uint64_t avalanche(std::uint64_t hash) {
  hash = (hash ^ (hash >> 33)) * kPrime2;
  hash = (hash ^ (hash >> 29)) * kPrime3;
  return hash ^ (hash >> 32);
}

}  // namespace

void Checksum::stripe(const std::byte* bytes) {
  for (std::size_t i = 0; i < 4; ++i) {
    lanes_[i] = turned(lanes_[i], read<std::uint64_t>(bytes + 8 * i));
  }
}

Checksum& Checksum::add(std::span<const std::byte> bytes) {
  total_ += bytes.size();
  if (restBytes_ > 0) {
    const std::size_t more = std::min(kStripe - restBytes_, bytes.size());
    std::copy_n(bytes.data(), more, rest_.data() + restBytes_);
    restBytes_ += more;
    bytes = bytes.subspan(more);
    if (restBytes_ < kStripe) return *this;
    stripe(rest_.data());
    restBytes_ = 0;
  }
  for (; bytes.size() >= kStripe; bytes = bytes.subspan(kStripe)) stripe(bytes.data());
  std::copy_n(bytes.data(), bytes.size(), rest_.data());
  restBytes_ = bytes.size();
  return *this;
}

std::uint64_t Checksum::mixedLanes() const {
  if (total_ < kStripe) return kPrime5;
  std::uint64_t hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) +
                       std::rotl(lanes_[2], 12) + std::rotl(lanes_[3], 18);
  for (const std::uint64_t lane : lanes_) hash = (hash ^ turned(0, lane)) * kPrime1 + kPrime4;
  return hash;
}

std::uint64_t Checksum::value() const {
  std::uint64_t hash = mixedLanes() + total_;
  const std::byte* at = rest_.data();
  const std::byte* const end = at + restBytes_;
  for (; end - at >= 8; at += 8) {
    hash = std::rotl(hash ^ turned(0, read<std::uint64_t>(at)), 27) * kPrime1 + kPrime4;
  }
  if (end - at >= 4) {
    hash = std::rotl(hash ^ (read<std::uint32_t>(at) * kPrime1), 23) * kPrime2 + kPrime3;
    at += 4;
  }
  for (; at != end; ++at) {
    hash = std::rotl(hash ^ (std::to_integer<std::uint64_t>(*at) * kPrime5), 11) * kPrime1;
  }
  return avalanche(hash);
}

}  // namespace ifa
