// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ReadFile, GivesTheBytesAsTheyAre) {
  const test::TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  test::writeText(folder / "file", bytes);
  EXPECT_EQ(readFile(folder / "file", 100).value(), bytes);
  test::writeText(folder / "empty", "");
  EXPECT_EQ(readFile(folder / "empty", 100).value(), "");
}

TEST(ReadFile, RefusesWhatIsTooLarge) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "file", std::string(1001, 'x'));
  EXPECT_TRUE(readFile(folder / "file", 1001));
  const auto result = readFile(folder / "file", 1000);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  EXPECT_THAT(result.error().message, HasSubstr("larger"));
  // A device without an end must not be read to the end.
  EXPECT_FALSE(readFile("/dev/zero", 1 << 20));
}

TEST(ReadFile, SaysWhatIsWrongWithThePath) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(readFile(folder / "none", 10).error().text(), HasSubstr("no such file"));
  EXPECT_THAT(readFile(folder.path(), 10).error().text(), HasSubstr("is a folder"));
  EXPECT_EQ(readFile(folder / "none", 10).error().place, folder / "none");
}

TEST(WriteFileAtomically, WritesAndReplaces) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(writeFileAtomically(folder / "file", "one"));
  ASSERT_TRUE(writeFileAtomically(folder / "file", std::string_view("two\0", 4)));
  EXPECT_EQ(test::readText(folder / "file"), std::string("two\0", 4));
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(WriteFileAtomically, GivesThePermissionsThatTheUserAskedFor) {
  const test::TemporaryFolder folder;
  const mode_t before = ::umask(027);
  ASSERT_TRUE(writeFileAtomically(folder / "file", "x"));
  ::umask(before);
  const auto permissions = fs::status(folder / "file").permissions();
  EXPECT_EQ(permissions, static_cast<fs::perms>(0640));
}

TEST(WriteFileAtomically, LeavesNothingWhereItCannotWrite) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "file", "old");
  for (const fs::path& place :
       {folder / "file/below", folder / "no/such/folder/x", fs::path("/proc/x")}) {
    const auto result = writeFileAtomically(place, "new");
    ASSERT_FALSE(result) << place;
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
    EXPECT_EQ(result.error().place, place);
  }
  EXPECT_EQ(test::readText(folder / "file"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(WriteFileAtomically, KeepsTheOldFileWhenTheNewOneCannotTakeItsPlace) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "name");
  EXPECT_FALSE(writeFileAtomically(folder / "name", "x"));
  EXPECT_THAT(folder.names(), ElementsAre("name"));
}

TEST(WriteFileAtomically, RespectsAReadOnlyFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const test::TemporaryFolder folder;
  ::chmod(folder.path().c_str(), 0555);
  EXPECT_FALSE(writeFileAtomically(folder / "file", "x"));
  ::chmod(folder.path().c_str(), 0755);
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace ifa
