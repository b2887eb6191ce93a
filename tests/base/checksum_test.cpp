// SPDX-License-Identifier: Apache-2.0
#include "base/checksum.h"

#include <gtest/gtest.h>

#include <string>

namespace ifa {
namespace {

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::uint64_t checksumOf(const std::string& text) { return Checksum().add(bytesOf(text)).value(); }

TEST(Checksum, GivesTheKnownValuesOfXxh64) {
  EXPECT_EQ(checksumOf(""), 0xEF46DB3751D8E999ULL);
  EXPECT_EQ(checksumOf("a"), 0xD24EC4F1A98C6E5BULL);
  EXPECT_EQ(checksumOf("abc"), 0x44BC2CF5AD770999ULL);
  EXPECT_EQ(checksumOf("Nobody inspects the spammish repetition"), 0xFBCEA83C8A378BF1ULL);
}

TEST(Checksum, DoesNotDependOnHowTheBytesCome) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += static_cast<char>(i * 37);
  for (std::size_t length = 0; length < text.size(); length += 7) {
    for (std::size_t cut = 0; cut <= length; cut += 5) {
      Checksum parts;
      parts.add(bytesOf(text.substr(0, cut))).add(bytesOf(text.substr(cut, length - cut)));
      EXPECT_EQ(parts.value(), checksumOf(text.substr(0, length))) << length << ' ' << cut;
    }
  }
}

TEST(Checksum, SeesEveryFlippedBit) {
  const std::string good(77, 'x');
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(checksumOf(bad), checksumOf(good)) << bit;
  }
}

}  // namespace
}  // namespace ifa
