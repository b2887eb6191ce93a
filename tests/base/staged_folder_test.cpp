// SPDX-License-Identifier: Apache-2.0
#include "base/staged_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(StagedFolder, ShowsNothingBeforeItIsCommitted) {
  const test::TemporaryFolder folder;
  {
    auto staged = StagedFolder::open(folder / "a/b/out").value();
    test::writeText(staged.path() / "file", "x");
    EXPECT_FALSE(fs::exists(folder / "a/b/out/file"));
  }
  EXPECT_THAT(folder.names(), IsEmpty()) << "folders made for nothing are taken away again";
}

TEST(StagedFolder, MovesEverythingIntoPlace) {
  const test::TemporaryFolder folder;
  auto staged = StagedFolder::open(folder / "out/").value();
  test::writeText(staged.path() / "file", "x");
  fs::create_directory(staged.path() / "take-1");
  test::writeText(staged.path() / "take-1/motion.json", "y");
  ASSERT_TRUE(staged.commit("motion.json", {}));
  { const auto moved = std::move(staged); }
  EXPECT_THAT(folder.names(),
              ElementsAre("out", "out/file", "out/take-1", "out/take-1/motion.json"));
}

TEST(StagedFolder, ReplacesAnEarlierRunAndNothingElse) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "out/take-1");
  for (const char* name :
       {"out/motion.json", "out/motion.glb", "out/mine", "out/take-1/motion.json"}) {
    test::writeText(folder / name, "old");
  }
  {
    auto staged = StagedFolder::open(folder / "out").value();
    test::writeText(staged.path() / "motion.json", "new");
    ASSERT_TRUE(staged.commit("motion.json", {"motion.json", "motion.glb", "take-1/motion.json"}));
  }
  EXPECT_THAT(folder.names(), ElementsAre("out", "out/mine", "out/motion.json", "out/take-1"));
  EXPECT_EQ(test::readText(folder / "out/motion.json"), "new");
}

TEST(StagedFolder, LeavesAnEarlierRunAloneWhenItIsGivenUp) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "out");
  test::writeText(folder / "out/motion.json", "old");
  {
    auto staged = StagedFolder::open(folder / "out").value();
    test::writeText(staged.path() / "motion.json", "new");
  }
  EXPECT_THAT(folder.names(), ElementsAre("out", "out/motion.json"));
  EXPECT_EQ(test::readText(folder / "out/motion.json"), "old");
}

TEST(StagedFolder, SaysAtOnceThatItCannotWrite) {
  const test::TemporaryFolder folder;
  test::writeText(folder / "file", "x");
  for (const fs::path& place : {folder / "file", folder / "file/below", fs::path("/proc/none/x")}) {
    const auto staged = StagedFolder::open(place);
    ASSERT_FALSE(staged) << place;
    EXPECT_EQ(staged.error().code, ErrorCode::kBadInput);
  }
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

}  // namespace
}  // namespace ifa
