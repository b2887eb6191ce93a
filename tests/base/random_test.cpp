// SPDX-License-Identifier: Apache-2.0
#include "base/random.h"

#include <gtest/gtest.h>

#include <set>

namespace ifa {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers of Salmon et al. (Random123, kat_vectors, philox4x32 10).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, IsTheBlocksOfItsKeyInOrder) {
  RandomStream stream(0x299f31d0a4093822, 0x0370734413198a2e);
  const auto first = philox4x32({0, 0, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0});
  const auto second = philox4x32({1, 0, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0});
  EXPECT_EQ(stream.bits(), (std::uint64_t{first[1]} << 32) | first[0]);
  EXPECT_EQ(stream.bits(), (std::uint64_t{first[3]} << 32) | first[2]);
  EXPECT_EQ(stream.bits(), (std::uint64_t{second[1]} << 32) | second[0]);
}

TEST(RandomStream, DependsOnSeedAndStreamOnly) {
  RandomStream one(1, 2), same(1, 2), otherSeed(2, 2), otherStream(1, 3);
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 1000; ++i) {
    const auto bits = one.bits();
    EXPECT_EQ(bits, same.bits());
    seen.insert({bits, otherSeed.bits(), otherStream.bits()});
  }
  EXPECT_EQ(seen.size(), 3000U);
}

TEST(RandomStream, UniformHasTheMomentsOfAUniformVariable) {
  RandomStream stream(7, 0);
  double sum = 0, squares = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double value = stream.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    squares += value * value;
  }
  // Four standard errors.
  EXPECT_NEAR(sum / kCount, 0.5, 0.0037);
  EXPECT_NEAR(squares / kCount, 1.0 / 3, 0.0038);
}

TEST(RandomStream, BelowReachesEveryValueAndNoOther) {
  RandomStream stream(7, 1);
  std::array<int, 6> counts{};
  for (int i = 0; i < 6000; ++i) ++counts.at(stream.below(6));
  for (const int count : counts) EXPECT_NEAR(count, 1000, 120);
}

}  // namespace
}  // namespace ifa
