// SPDX-License-Identifier: Apache-2.0
#include "base/raw_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

using testing::HasSubstr;

const std::array<std::byte, 3> kBytes = {std::byte{1}, std::byte{2}, std::byte{3}};

TEST(RawFile, ReadsBackWhatWasWrittenAtAnOffset) {
  const test::TemporaryFolder folder;
  auto file = RawFile::open(folder / "f", RawFile::Mode::kUpdate);
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write(kBytes, 10));
  EXPECT_EQ(file->size().value(), 13U);
  std::array<std::byte, 3> back{};
  ASSERT_TRUE(file->read(back, 10));
  EXPECT_EQ(back, kBytes);
  ASSERT_TRUE(file->resize(12));
  EXPECT_THAT(file->read(back, 10).error().text(), HasSubstr("ends too early"));
}

TEST(RawFile, KeepsOrEmptiesWhatIsThere) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "f", "before");
  EXPECT_EQ(RawFile::open(folder / "f", RawFile::Mode::kUpdate)->size().value(), 6U);
  EXPECT_EQ(RawFile::open(folder / "f", RawFile::Mode::kReplace)->size().value(), 0U);
}

TEST(RawFile, SaysWhatIsWrong) {
  const test::TemporaryFolder folder;
  const auto missing = RawFile::open(folder / "no", RawFile::Mode::kRead);
  EXPECT_THAT(missing.error().text(), HasSubstr("no such file"));
  EXPECT_THAT(RawFile::open(folder.path(), RawFile::Mode::kRead).error().text(),
              HasSubstr("is not a file"));
  const auto nowhere = RawFile::open(folder / "no" / "f", RawFile::Mode::kUpdate);
  EXPECT_THAT(nowhere.error().text(), HasSubstr("check that the folder exists"));
}

TEST(FileLock, IsHeldByOneAtATime) {
  const test::TemporaryFolder folder;
  {
    auto first = FileLock::take(folder / "f");
    ASSERT_TRUE(first);
    const auto second = FileLock::take(folder / "f");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kBadInput);
    EXPECT_THAT(second.error().text(), HasSubstr("is being made by another process"));
    EXPECT_TRUE(FileLock::take(folder / "other"));
  }
  EXPECT_THAT(folder.names(), testing::IsEmpty());
  EXPECT_TRUE(FileLock::take(folder / "f"));
}

TEST(FileLock, IsWaitedForUntilItIsFreeOrToldToStop) {
  const test::TemporaryFolder folder;
  auto held = std::make_optional(FileLock::take(folder / "f"));
  int asked = 0;
  const auto stopped = FileLock::await(folder / "f", [&asked] { return ++asked > 2; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
  asked = 0;
  const auto freed = FileLock::await(folder / "f", [&] {
    if (++asked == 3) held.reset();
    return false;
  });
  EXPECT_TRUE(freed);
  EXPECT_EQ(asked, 3);
}

TEST(FileLock, IsNotHeldByALeftover) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "f.lock", "");
  EXPECT_TRUE(FileLock::take(folder / "f"));
}

}  // namespace
}  // namespace ifa
