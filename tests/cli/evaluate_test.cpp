// SPDX-License-Identifier: Apache-2.0
// `ifa evaluate`: reports of one set, and of several reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "run_program.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Evaluate, PutsReportsSideBySide) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "set");
  fs::copy(fs::path(IFA_SOURCE_DIR) / "tests/evaluation/Eraser", folder / "set/Eraser");
  const auto run = [&](const std::string& report, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"evaluate",  folder / "set", "--limit", "1",
                                      "--planner", "shoot",        "-o",      folder / report};
    words.insert(words.end(), more.begin(), more.end());
    return runProgram(words);
  };
  ASSERT_EQ(run("plain", {}).exit, 0);
  const auto oriented = run("oriented", {"--orient", "last:0,0,1=up"});
  ASSERT_EQ(oriented.exit, 0) << oriented.err;
  EXPECT_THAT(oriented.out, HasSubstr("| Eraser | shoot, last:0,0,1=up |"));
  const auto both = runProgram(
      {"evaluate", folder / "plain.json", folder / "oriented.json", "-o", folder / "both.json"});
  ASSERT_EQ(both.exit, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("| Eraser | shoot | none | 1 |"));
  EXPECT_THAT(both.out, HasSubstr("|  | shoot, last:0,0,1=up | none | 1 |"));
  EXPECT_THAT(both.out, HasSubstr("|  | paper | 2003606 |"));
  EXPECT_THAT(readText(folder / "both.md"), HasSubstr("](both-bend.svg)"));
  EXPECT_TRUE(fs::exists(folder / "both-bend.svg"));
}

TEST(Evaluate, RefusesWhatItCannotPutTogether) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "a");
  const auto folders = runProgram({"evaluate", folder / "a", folder / "a"});
  EXPECT_EQ(folders.exit, 2);
  EXPECT_THAT(folders.err, HasSubstr("only reports can be several"));
  EXPECT_EQ(runProgram({"evaluate", folder / "a", "--orient", "last=up"}).exit, 2);
  writeText(folder / "no.json", R"({"format": "inverse-foley-motion"})");
  const auto motion = runProgram({"evaluate", folder / "no.json"});
  EXPECT_EQ(motion.exit, 3);
  EXPECT_EQ(runProgram({"evaluate", folder / "no.json", folder / "a"}).exit, 2);
  EXPECT_THAT(motion.err, HasSubstr("'format' is another format"));
}

}  // namespace
}  // namespace ifa::test
