// SPDX-License-Identifier: Apache-2.0
#include "render/sample_table.h"

#include <cmath>

namespace ifa::render {
namespace {

std::uint32_t reversed(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

// Burley's constants: every bit is flipped by a hash of the bits above it.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x = reversed(x);
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reversed(x);
}

std::uint32_t hashed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

// Second dimension of Sobol's sequence; the first is the reversed index.
std::uint32_t sobolSecond(std::uint32_t index) {
  std::uint32_t direction = 1u << 31, result = 0;
  for (; index != 0; index >>= 1, direction ^= direction >> 1) {
    if ((index & 1) != 0) result ^= direction;
  }
  return result;
}

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// Point `index` of the pair of dimensions number `pair`.
std::array<float, 2> point(std::uint32_t index, std::uint32_t pair) {
  const std::uint32_t shuffled = scrambled(index, hashed(4 * pair + 1));
  return {unit(scrambled(reversed(shuffled), hashed(4 * pair + 2))),
          unit(scrambled(sobolSecond(shuffled), hashed(4 * pair + 3)))};
}

Sample sampleAt(std::uint32_t index) {
  Sample s;
  const auto fill = [index](std::uint32_t pair, float& a, float& b) {
    const auto p = point(index, pair);
    a = p[0], b = p[1];
  };
  float time = 0;
  fill(0, s.x, s.y);
  fill(1, s.key0, s.key1);
  const auto fillDisc = [index](std::uint32_t pair, float& x, float& y) {
    const auto p = point(index, pair);
    const float radius = std::sqrt(p[0]), angle = 6.28318531f * p[1];
    x = radius * std::cos(angle), y = radius * std::sin(angle);
  };
  fillDisc(2, s.diffuseX, s.diffuseY);
  fillDisc(3, s.specularX, s.specularY);
  fill(4, time, s.choice);
  s.instant = static_cast<std::uint8_t>(time * kInstants);
  return s;
}

}  // namespace

SampleTable::SampleTable(int perPixel) : perPixel_(perPixel) {
  constexpr std::uint32_t kBlocks = kTile * kTile;
  samples_.reserve(static_cast<std::size_t>(kBlocks) * static_cast<std::size_t>(perPixel));
  for (std::uint32_t block = 0; block < kBlocks; ++block) {
    // An odd factor visits every block once, and neighbours get blocks that lie far apart.
    const std::uint32_t first = (block * 37 % kBlocks) * static_cast<std::uint32_t>(perPixel);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(perPixel); ++i) {
      samples_.push_back(sampleAt(first + i));
    }
  }
}

}  // namespace ifa::render
