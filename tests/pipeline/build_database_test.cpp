// SPDX-License-Identifier: Apache-2.0
#include "pipeline/build_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "base/parallel.h"
#include "base/raw_file.h"
#include "database/database.h"
#include "database/journal.h"
#include "database/merge.h"
#include "sampler/drop_statistics.h"
#include "sampler/event_chain.h"
#include "support/box_body.h"
#include "support/temporary_folder.h"

namespace ifa {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BuildDatabaseTest : public testing::Test {
 protected:
  BuildDatabaseTest() {
    request_.body = &die_;
    request_.surfaceName = "table";
    request_.surface.restitution = 0.6;
    request_.surface.referenceImpulse = 0.0147;
    request_.simulations = 700;
  }
  std::string built(const fs::path& path) {
    const auto build = buildDatabase(request_, path, {});
    EXPECT_TRUE(build) << build.error().text();
    return test::readText(path);
  }
  std::string refusal(const fs::path& path) {
    const auto build = buildDatabase(request_, path, {});
    return build ? std::string() : build.error().text();
  }
  /// Leaves a part file with some of the simulations.
  void interrupt(const fs::path& path) {
    std::atomic<bool> stop = false;
    const auto build = buildDatabase(
        request_, path, {[&](std::string_view, double share) { stop = share > 0.3; }, &stop});
    ASSERT_FALSE(build);
    EXPECT_EQ(build.error().code, ErrorCode::kInterrupted);
    EXPECT_THAT(build.error().text(), HasSubstr("of 700 simulations"));
    EXPECT_THAT(build.error().text(), HasSubstr("--resume"));
    EXPECT_TRUE(fs::exists(journalPath(path)));
    EXPECT_FALSE(fs::exists(path));
  }

  test::TemporaryFolder folder_;
  Body die_ = makeDieBody();
  DatabaseRequest request_;
};

TEST_F(BuildDatabaseTest, GivesTheSameBytesOnAnyNumberOfThreads) {
  const std::string whole = built(folder_ / "a");
  for (const int threads : {1, 2, 5}) {
    setThreadCount(threads);
    EXPECT_EQ(built(folder_ / "b"), whole);
  }
  setThreadCount(0);
  EXPECT_THAT(folder_.names(), testing::ElementsAre("a", "b"));
}

TEST_F(BuildDatabaseTest, ShardsMergeToTheSameBytes) {
  const std::string whole = built(folder_ / "whole");
  for (const std::uint64_t shards : {1, 2, 7}) {
    std::vector<fs::path> files;
    request_.shards = shards;
    for (request_.shard = 1; request_.shard <= shards; ++request_.shard) {
      files.push_back(folder_ / (std::to_string(request_.shard) + " of " + std::to_string(shards)));
      (void)built(files.back());
    }
    ASSERT_TRUE(mergeDatabases(files, folder_ / "merged", {}));
    EXPECT_EQ(test::readText(folder_ / "merged"), whole);
  }
}

TEST_F(BuildDatabaseTest, GoesOnAfterAnInterruption) {
  const std::string whole = built(folder_ / "a");
  interrupt(folder_ / "b");
  request_.resume = true;
  const auto build = buildDatabase(request_, folder_ / "b", {});
  ASSERT_TRUE(build) << build.error().text();
  EXPECT_GT(build->simulatedBefore, 0U);
  EXPECT_EQ(test::readText(folder_ / "b"), whole);
  EXPECT_THAT(folder_.names(), testing::ElementsAre("a", "b"));
}

TEST_F(BuildDatabaseTest, DoesNotThrowAwayAnInterruptedBuild) {
  interrupt(folder_ / "b");
  EXPECT_THAT(refusal(folder_ / "b"), HasSubstr("an interrupted build is there"));
  request_.resume = true;
  request_.surface.restitution = 0.5;
  EXPECT_THAT(refusal(folder_ / "b"), HasSubstr("restitution 0.6 there, 0.5 here"));
  request_.surface.restitution = 0.6;
  die_.hull[0].x() *= 1.0001;
  EXPECT_THAT(refusal(folder_ / "b"), HasSubstr("shape or mass of the body"));
}

TEST_F(BuildDatabaseTest, ResumingWhatIsDoneOrNotBegunIsNoError) {
  request_.resume = true;
  const auto first = buildDatabase(request_, folder_ / "a", {});
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->wasThere);
  const auto second = buildDatabase(request_, folder_ / "a", {});
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->wasThere);
  EXPECT_EQ(second->events, first->events);
  request_.seed = 2;
  EXPECT_FALSE(buildDatabase(request_, folder_ / "a", {})->wasThere);
}

TEST_F(BuildDatabaseTest, OneBuildAtATimeIntoAFile) {
  const auto lock = FileLock::take(folder_ / "a");
  EXPECT_THAT(refusal(folder_ / "a"), HasSubstr("is being made by another process"));
}

TEST_F(BuildDatabaseTest, RefusesWhatCannotBeWritten) {
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("is a folder"));
  EXPECT_THAT(refusal(folder_ / "no" / "a"), HasSubstr("cannot be written"));
}

TEST_F(BuildDatabaseTest, RefusesAShardThatCannotBe) {
  request_.shards = 2;
  for (const std::uint64_t shard : {0, 3}) {
    request_.shard = shard;
    EXPECT_THAT(refusal(folder_ / "a"), HasSubstr("there is no shard"));
  }
  request_.shards = 701;
  request_.shard = 1;
  EXPECT_THAT(refusal(folder_ / "a"), HasSubstr("there is no shard"));
}

TEST_F(BuildDatabaseTest, EveryEventIsReplayedFromTheFile) {
  (void)built(folder_ / "a");
  const auto database = EventDatabase::open(folder_ / "a");
  ASSERT_TRUE(database);
  const BodyModel model(die_, request_.surface);
  EventChain chain(model, audibleCut(die_, request_.surface));
  for (std::size_t i = 0; i < database->events(); i += 7) {
    const EventRecord stored = database->record(i);
    const ChainLink link = chain.follow(stored.before, 20);
    ASSERT_TRUE(link.heard);
    EXPECT_EQ(pack(link.event.after), stored.after);
    EXPECT_EQ(link.event.terminal, stored.has(EventRecord::kTerminal));
  }
}

TEST_F(BuildDatabaseTest, TheOtherEngineMakesAFileOfItsOwn) {
  request_.simulations = 40;
  const std::string native = built(folder_ / "native");
  request_.backend = Backend::kOde;
  const std::string ode = built(folder_ / "ode");
  EXPECT_NE(ode, native);
  EXPECT_EQ(built(folder_ / "again"), ode);
  const auto database = EventDatabase::open(folder_ / "ode");
  ASSERT_TRUE(database);
  EXPECT_TRUE(database->check());
  EXPECT_GT(database->events(), 100U);
  std::size_t flights = 0;
  for (std::size_t i = 0; i < database->events(); ++i) {
    const EventRecord record = database->record(i);
    if (!record.has(EventRecord::kFollowed) || record.has(EventRecord::kSilentPassage)) continue;
    ++flights;
    EXPECT_NEAR(database->record(i + 1).before.velocity[2] - record.after.velocity[2],
                -kGravity * record.gap, 1e-3);
  }
  EXPECT_GT(flights, 50U);
}

/// Any impulse counts: an event lasts until nothing touches for a merge gap, or the body rests.
TEST_F(BuildDatabaseTest, ThePapersCutIsAnotherDatabase) {
  const std::string audible = built(folder_ / "audible");
  request_.cut = EventCut::kPaper;
  EXPECT_NE(built(folder_ / "paper"), audible);
  const auto database = EventDatabase::open(folder_ / "paper");
  ASSERT_TRUE(database);
  EXPECT_EQ(cutOf(database->header().identity.settings), EventCut::kPaper);
  EXPECT_EQ(cutOf(EventDatabase::open(folder_ / "audible")->header().identity.settings),
            EventCut::kAudible);
  std::size_t followed = 0, terminal = 0;
  for (std::size_t i = 0; i < database->events(); ++i) {
    const EventRecord record = database->record(i);
    terminal += record.has(EventRecord::kTerminal) ? 1 : 0;
    if (!record.has(EventRecord::kFollowed)) continue;
    ++followed;
    EXPECT_GE(record.gap, static_cast<float>(die_.definition.mergeGap));
    EXPECT_FALSE(record.has(EventRecord::kSilentPassage));
  }
  EXPECT_EQ(terminal, 700U);
  EXPECT_GT(followed, 2 * terminal);
  interrupt(folder_ / "d");
  request_.cut = EventCut::kAudible;
  request_.resume = true;
  EXPECT_THAT(refusal(folder_ / "d"), HasSubstr("cut paper there, audible here"));
}

TEST_F(BuildDatabaseTest, TheCacheTellsDatabasesApart) {
  std::vector<fs::path> paths = {cachedDatabasePath(identityOf(request_))};
  EXPECT_EQ(cachedDatabasePath(identityOf(request_)), paths[0]);
  const auto differs = [&](auto change) {
    const DatabaseRequest before = request_;
    change();
    paths.push_back(cachedDatabasePath(identityOf(request_)));
    request_ = before;
  };
  differs([&] { request_.seed = 2; });
  differs([&] { request_.simulations = 701; });
  differs([&] { request_.surface.friction = 0.4; });
  differs([&] { request_.backend = Backend::kOde; });
  differs([&] { request_.cut = EventCut::kPaper; });
  differs([&] { die_.mass *= 2; });
  std::sort(paths.begin(), paths.end());
  EXPECT_EQ(std::unique(paths.begin(), paths.end()), paths.end());
}

TEST_F(BuildDatabaseTest, AReferenceImpulseThatIsMissingIsLearnt) {
  EXPECT_EQ(withReferenceImpulse(die_, request_.surface, {}).referenceImpulse, 0.0147);
  request_.surface.referenceImpulse = 0;
  EXPECT_NEAR(withReferenceImpulse(die_, request_.surface, {}).referenceImpulse, 0.014, 0.003);
}

}  // namespace
}  // namespace ifa
