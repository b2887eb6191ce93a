// SPDX-License-Identifier: Apache-2.0
#include "database/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "database_files.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class MergeTest : public testing::Test {
 protected:
  void SetUp() override { test::writeDatabase(folder_ / "whole", test::headerOfRange(0, 30, 30)); }
  fs::path shard(std::uint64_t first, std::uint64_t end) {
    const fs::path path = folder_ / ("shard-" + std::to_string(first));
    test::writeDatabase(path, test::headerOfRange(first, end - first, 30), 3);
    return path;
  }
  [[nodiscard]] std::string failure(const std::vector<fs::path>& shards) const {
    test::writeText(out_, "older");
    const auto merged = mergeDatabases(shards, out_, {});
    EXPECT_EQ(test::readText(out_), "older");
    EXPECT_EQ(merged.error().code, ErrorCode::kBadInput);
    return merged.error().text();
  }

  test::TemporaryFolder folder_;
  fs::path out_ = folder_ / "merged";
};

TEST_F(MergeTest, GivesTheUnshardedFileInWhateverOrder) {
  for (std::uint64_t cut = 1; cut < 29; cut += 3) {
    const auto a = shard(0, cut), b = shard(cut, cut + 1), c = shard(cut + 1, 30);
    for (const auto& order : {std::vector{a, b, c}, std::vector{c, a, b}}) {
      const auto merged = mergeDatabases(order, out_, {});
      ASSERT_TRUE(merged) << merged.error().text();
      EXPECT_EQ(test::readText(out_), test::readText(folder_ / "whole"));
    }
  }
}

TEST_F(MergeTest, RefusesWhatIsNotComplete) {
  const auto a = shard(0, 10), b = shard(10, 20), c = shard(20, 30);
  EXPECT_THAT(failure({a, c}), HasSubstr("simulations 10 to 19 of 30 are missing"));
  EXPECT_THAT(failure({b, c}), HasSubstr("simulations 0 to 9 of 30 are missing"));
  EXPECT_THAT(failure({a, b}), HasSubstr("simulations 20 to 29 of 30 are missing"));
  EXPECT_THAT(failure({a, b, b, c}), HasSubstr("simulation 10 is in another shard, too"));
}

TEST_F(MergeTest, RefusesShardsOfAnotherDatabase) {
  DatabaseHeader other = test::headerOfRange(10, 20, 30);
  other.identity.seed = 8;
  test::writeDatabase(folder_ / "other", other);
  const std::string text = failure({shard(0, 10), folder_ / "other"});
  EXPECT_THAT(text, HasSubstr("seed 8 there, 7 here"));
  EXPECT_THAT(text, HasSubstr("other: "));
}

TEST_F(MergeTest, RefusesADamagedShard) {
  const auto a = shard(0, 10), b = shard(10, 30);
  std::string bytes = test::readText(b);
  bytes[5000] = static_cast<char>(bytes[5000] ^ 1);
  test::writeText(b, bytes);
  EXPECT_THAT(failure({a, b}), HasSubstr("is damaged"));
  EXPECT_THAT(failure({a, folder_ / "missing"}), HasSubstr("no such file"));
}

TEST_F(MergeTest, LeavesNothingWhenInterrupted) {
  const std::vector<fs::path> shards = {shard(0, 10), shard(10, 30)};
  const auto before = folder_.names();
  const std::atomic<bool> stop = true;
  const auto merged = mergeDatabases(shards, out_, {{}, &stop});
  ASSERT_FALSE(merged);
  EXPECT_EQ(merged.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(folder_.names(), before);
}

}  // namespace
}  // namespace ifa
