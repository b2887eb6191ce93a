// SPDX-License-Identifier: Apache-2.0
// `ifa database` through the program: kills, full disks, two at once, bad files and bad flags.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "base/random.h"
#include "base/raw_file.h"
#include "run_program.h"
#include "support/temporary_folder.h"

namespace ifa::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DatabaseCommand : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> build(const std::string& name,
                                               std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"database", "build", "d6", "-n", count_, "-o", at(name)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string whole() {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(runProgram(build("whole")).exit, 0);
    wholeTook_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return readText(folder_ / "whole");
  }
  /// Builds to the end, after whole(), in many lives of random length; tells how many of them were
  /// cut short. However slow this build of the program is, some are long enough for a piece of the
  /// work.
  int buildInManyLives(const std::string& name, RandomStream& random) const {
    for (int kills = 0;; ++kills) {
      const double seconds = random.uniform(0, std::max(0.25, wholeTook_));
      const auto life = runAndKill(build(name, {"--resume"}), seconds);
      if (life.exit == 0) return kills;
      EXPECT_EQ(life.exit, -1) << life.err;
      if (life.exit != -1 || kills > 1000) return kills;
    }
  }

  std::string count_ = "500";
  double wholeTook_ = 0;  // s
  TemporaryFolder folder_;
};

TEST_F(DatabaseCommand, BuildsAndTellsWhatIsInTheFile) {
  const auto built = runProgram(build("d"));
  ASSERT_EQ(built.exit, 0) << built.err;
  EXPECT_THAT(built.out, HasSubstr("500 simulations, "));
  const auto info = runProgram({"database", "info", at("d"), "--check", "--object", "d6"});
  EXPECT_EQ(info.exit, 0) << info.err;
  for (const char* part : {"d6 on desk", "0 to 499 of 500, seed 1", "bytes an event", "restitution",
                           "median", "every checksum holds"}) {
    EXPECT_THAT(info.out, HasSubstr(part));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("d"));
}

TEST_F(DatabaseCommand, TellsByWhichCutItWasMade) {
  ASSERT_EQ(runProgram(build("d", {"--cut", "paper"})).exit, 0);
  EXPECT_NE(readText(folder_ / "d"), whole());
  EXPECT_THAT(runProgram({"database", "info", at("d")}).out,
              HasSubstr("  cut             paper\n"));
  EXPECT_THAT(runProgram({"database", "info", at("whole")}).out,
              HasSubstr("  cut             audible\n"));
}

TEST_F(DatabaseCommand, ShardsMergeToTheFileOfOneBuild) {
  std::vector<std::string> merge = {"database", "merge", "-o", at("merged")};
  for (const std::string shard : {"3/3", "1/3", "2/3"}) {
    const std::string name = "shard-" + shard.substr(0, 1);
    ASSERT_EQ(runProgram(build(name, {"--shard", shard, "--threads", shard.substr(0, 1)})).exit, 0);
    merge.push_back(at(name));
  }
  ASSERT_EQ(runProgram(merge).exit, 0);
  EXPECT_EQ(readText(folder_ / "merged"), whole());
  merge.pop_back();
  const auto missing = runProgram(merge);
  EXPECT_EQ(missing.exit, 3);
  EXPECT_THAT(missing.err, HasSubstr("are missing"));
}

TEST_F(DatabaseCommand, AKilledBuildGoesOn) {
  RandomStream random(5, 0);
  count_ = "2000";
  const std::string expected = whole();
  (void)buildInManyLives("d", random);
  EXPECT_EQ(readText(folder_ / "d"), expected);
  EXPECT_THAT(folder_.names(), ElementsAre("d", "whole"));
}

TEST_F(DatabaseCommand, SlowAHundredKillsLoseNothing) {
  RandomStream random(6, 0);
  count_ = "3000";
  const std::string expected = whole();
  for (int kills = 0, builds = 0; kills < 100; ++builds) {
    const std::string name = "d" + std::to_string(builds);
    kills += buildInManyLives(name, random);
    ASSERT_EQ(readText(folder_ / name), expected) << name;
    ASSERT_FALSE(fs::exists(folder_ / (name + ".part")));
    fs::remove(folder_ / name);
  }
  EXPECT_THAT(folder_.names(), ElementsAre("whole"));
}

TEST_F(DatabaseCommand, AnInterruptionKeepsWhatIsDone) {
  count_ = "20000";
  const auto stopped =
      runAndSignal(build("d", {"--json-progress"}), "\"stage\":\"build\",\"value\":0.0", SIGINT);
  EXPECT_EQ(stopped.exit, 5) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("--resume"));
  EXPECT_THAT(folder_.names(), ElementsAre("d.part"));
  const auto anew = runProgram(build("d"));
  EXPECT_EQ(anew.exit, 3);
  EXPECT_THAT(anew.err, HasSubstr("an interrupted build is there"));
  const auto other = runProgram(build("d", {"--resume", "--seed", "9"}));
  EXPECT_EQ(other.exit, 3);
  EXPECT_THAT(other.err, HasSubstr("seed 1 there, 9 here"));
  EXPECT_THAT(runProgram({"database", "info", at("d.part")}).err, HasSubstr("not done"));
}

TEST_F(DatabaseCommand, AFullDiskKeepsWhatIsDone) {
  const std::string expected = whole();
  for (const std::uint64_t room : {0, 1000, 5000, 400000}) {
    const auto full = runWithLargestFile(build("d", {"--resume"}), room);
    EXPECT_EQ(full.exit, 3) << full.err;
    EXPECT_THAT(full.err, HasSubstr("cannot be written"));
    EXPECT_THAT(full.err, HasSubstr("free some space"));
    EXPECT_FALSE(fs::exists(folder_ / "d"));
    EXPECT_FALSE(fs::exists(folder_ / "d.new"));
  }
  EXPECT_EQ(runProgram(build("d", {"--resume"})).exit, 0);
  EXPECT_EQ(readText(folder_ / "d"), expected);
}

TEST_F(DatabaseCommand, AFullDiskLeavesTheOlderFile) {
  (void)whole();
  ASSERT_EQ(runProgram(build("shard", {"--shard", "1/1"})).exit, 0);
  writeText(folder_ / "merged", "older");
  const auto full =
      runWithLargestFile({"database", "merge", at("shard"), "-o", at("merged")}, 300000);
  EXPECT_EQ(full.exit, 3);
  EXPECT_THAT(full.err, HasSubstr("cannot be written"));
  EXPECT_EQ(readText(folder_ / "merged"), "older");
  EXPECT_THAT(folder_.names(), ElementsAre("merged", "shard", "whole"));
}

TEST_F(DatabaseCommand, TwoBuildsIntoOneFileAreRefused) {
  const std::string expected = whole();
  {
    const auto first = FileLock::take(folder_ / "d");
    const auto second = runProgram(build("d", {"--resume"}));
    EXPECT_EQ(second.exit, 3);
    EXPECT_THAT(second.err, HasSubstr("is being made by another process"));
    const auto merge = runProgram({"database", "merge", at("whole"), "-o", at("d")});
    EXPECT_EQ(merge.exit, 3);
    EXPECT_THAT(merge.err, HasSubstr("is being made by another process"));
  }
  EXPECT_EQ(runProgram(build("d")).exit, 0);
  EXPECT_EQ(readText(folder_ / "d"), expected);
}

TEST_F(DatabaseCommand, BadFilesAreRefusedWithTheReason) {
  const std::string good = whole();
  const auto refusal = [&](const std::string& bytes, std::vector<std::string> more = {}) {
    writeText(folder_ / "bad", bytes);
    std::vector<std::string> all = {"database", "info", at("bad")};
    all.insert(all.end(), more.begin(), more.end());
    const auto result = runProgram(all);
    EXPECT_EQ(result.exit, 3);
    EXPECT_THAT(result.out, IsEmpty());
    return result.err;
  };
  EXPECT_THAT(refusal("no database"), HasSubstr("is not an event database"));
  EXPECT_THAT(refusal(good.substr(0, good.size() / 2)), HasSubstr("is cut off"));
  std::string flipped = good;
  flipped[200] = static_cast<char>(flipped[200] ^ 1);
  EXPECT_THAT(refusal(flipped), HasSubstr("has a damaged header"));
  flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  EXPECT_THAT(refusal(flipped, {"--check"}), HasSubstr("is damaged: column"));
  EXPECT_THAT(refusal(good, {"--object", "d8"}), HasSubstr("was made of another body: d6"));
  EXPECT_THAT(runProgram({"database", "info", at("no")}).err, HasSubstr("no such file"));
}

TEST_F(DatabaseCommand, WithoutAFileItGoesToTheCacheOnce) {
  const std::vector<std::string> call = {"database", "build",  "d6",      "-n",
                                         "300",      "--seed", "12345678"};
  const auto first = runProgram(call), second = runProgram(call);
  EXPECT_EQ(first.exit, 0) << first.err;
  EXPECT_EQ(second.exit, 0) << second.err;
  EXPECT_THAT(second.out, HasSubstr("already"));
  EXPECT_THAT(second.out, HasSubstr("inverse-foley"));
}

TEST_F(DatabaseCommand, BadCallsExitWithTwo) {
  const std::vector<std::vector<std::string>> calls = {
      {"database"},
      {"database", "nonsense"},
      {"database", "build", "d6", "-o", at("d")},
      {"database", "build", "-n", "5", "-o", at("d")},
      {"database", "build", "d6", "-n", "0", "-o", at("d")},
      {"database", "build", "d6", "-n", "-5", "-o", at("d")},
      {"database", "build", "d6", "-n", "many", "-o", at("d")},
      build("d", {"--shard", "0/2"}),
      build("d", {"--shard", "3/2"}),
      build("d", {"--shard", "1"}),
      build("d", {"--shard", "1/2x"}),
      build("d", {"--shard", "1/501"}),
      build("d", {"--backend", "bullet"}),
      build("d", {"--seed", "-1"}),
      {"database", "build", "d6", "-n", "50", "--shard", "1/2"},
      {"database", "merge", at("d")},
      {"database", "merge", "-o", at("d")},
      {"database", "info"}};
  for (const auto& call : calls) {
    const auto result = runProgram(call);
    EXPECT_EQ(result.exit, 2) << testing::PrintToString(call) << result.err;
    EXPECT_THAT(linesOf(result.err), testing::SizeIs(1)) << result.err;
  }
  EXPECT_THAT(folder_.names(), IsEmpty());
}

TEST_F(DatabaseCommand, BadInputExitsWithThree) {
  const auto object = runProgram({"database", "build", "dx", "-n", "5", "-o", at("d")});
  EXPECT_EQ(object.exit, 3);
  const auto surface = runProgram(build("d", {"--surface", "moon"}));
  EXPECT_EQ(surface.exit, 3);
  EXPECT_THAT(surface.err, HasSubstr("one of desk"));
  EXPECT_EQ(runProgram(build("no/such/folder")).exit, 3);
  EXPECT_THAT(folder_.names(), IsEmpty());
}

}  // namespace
}  // namespace ifa::test
