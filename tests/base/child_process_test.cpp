// SPDX-License-Identifier: Apache-2.0
#include "base/child_process.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace ifa {
namespace {

TEST(CallInChild, GivesBackAnyBytes) {
  std::string bytes(1 << 20, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7);
  EXPECT_TRUE(callInChild([&] { return bytes; }, 10) == bytes);
  EXPECT_EQ(callInChild([] { return std::string(); }, 10), "");
}

TEST(CallInChild, ChangesNothingHere) {
  int value = 1;
  EXPECT_EQ(callInChild(
                [&] {
                  value = 2;
                  return std::to_string(value);
                },
                10),
            "2");
  EXPECT_EQ(value, 1);
}

TEST(CallInChild, OutlivesWhateverTheChildDoes) {
  EXPECT_FALSE(callInChild([]() -> std::string { std::abort(); }, 10));
  EXPECT_FALSE(callInChild([]() -> std::string { throw std::runtime_error("no"); }, 10));
  EXPECT_FALSE(callInChild([]() -> std::string { std::_Exit(3); }, 10));
  volatile bool forever = true;
  EXPECT_FALSE(callInChild(
      [&] {
        while (forever) {
        }
        return std::string();
      },
      1));
}

TEST(CallInChild, GivesTheChildNoMoreMemoryThanIsSaid) {
  const auto fill = [](std::size_t bytes) {
    return std::to_string(std::string(bytes, 'x').size());
  };
  constexpr std::size_t kMebi = 1 << 20;
  EXPECT_TRUE(callInChild([&] { return fill(16 * kMebi); }, 10, 64 * kMebi));
  EXPECT_FALSE(callInChild([&] { return fill(128 * kMebi); }, 10, 64 * kMebi));
}

}  // namespace
}  // namespace ifa
