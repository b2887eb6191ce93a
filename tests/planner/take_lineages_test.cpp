// SPDX-License-Identifier: Apache-2.0
// Where a search is taken up again for other takes.
#include "planner/take_lineages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "planner/plan_difference.h"
#include "planner/shooting_cases.h"
#include "planner/shooting_plan.h"

namespace ifa {
namespace {

/// A pass over what was heard of a drop, and the best plan of it.
class TakeLineagesTest : public testing::Test {
 protected:
  TakeLineagesTest() : request_(test::requestFor(test::die())), settings_(test::smallSearch()) {
    request_.signature = test::signatures(test::die(), 1, 9, 11).front();
    problem_.emplace(request_, settings_);
    search_.emplace(*problem_, 0, 1);
    search_->run([] { return false; }, [](double) {});
    if (search_->complete().empty()) return;
    found_.push_back(planOf(*problem_, search_->path(search_->complete().front())));
  }
  [[nodiscard]] TakeLineages beside(std::size_t wanted) const {
    return lineagesBeside(found_, *search_, wanted, search_->levels() - 2);
  }
  void SetUp() override { ASSERT_FALSE(found_.empty()); }

  PlanRequest request_;
  ShootingPlannerSettings settings_;
  std::optional<ShootingProblem> problem_;
  std::optional<ShootingSearch> search_;
  std::vector<Plan> found_;
};

TEST_F(TakeLineagesTest, NoneGoesTheWayOfATakeThatWasFound) {
  const TakeLineages lineages = beside(5);
  ASSERT_GT(lineages.ways, 0U);
  Plan part = found_[0];
  part.contacts.resize(lineages.beginning.level + 1);
  std::set<unsigned> ways;
  for (const ShootingNode& node : lineages.beginning.beam) {
    EXPECT_EQ(node.level, static_cast<int>(lineages.beginning.level));
    EXPECT_TRUE(differentPaths(search_->pathTo(node), pathOf(part)));
    ways.insert(node.root);
  }
  EXPECT_EQ(ways.size(), lineages.ways);
}

TEST_F(TakeLineagesTest, TheMoreWaysAreWantedTheEarlierTheLevel) {
  const TakeLineages few = beside(2);
  const TakeLineages many = beside(12);
  EXPECT_GE(few.ways, 2U);
  EXPECT_GE(many.ways, few.ways);
  EXPECT_LE(many.beginning.level, few.beginning.level);
}

TEST_F(TakeLineagesTest, ASearchThatGoesOnKeepsWhatWasBefore) {
  TakeLineages lineages = beside(5);
  const std::size_t level = lineages.beginning.level;
  const std::vector<ShootingNode> beam = lineages.beginning.beam;
  ShootingSearch more(*problem_, *search_, 1000, 1, std::move(lineages.beginning));
  more.run([] { return false; }, [](double) {});
  const ShootingNode* farthest = more.farthest();
  ASSERT_NE(farthest, nullptr);
  ASSERT_GT(farthest->level, static_cast<int>(level));
  const std::vector<ShootingNode> path = more.path(*farthest);
  ASSERT_EQ(path.size(), static_cast<std::size_t>(farthest->level) + 1);
  const ShootingNode& taken = path[level];
  EXPECT_TRUE(std::any_of(beam.begin(), beam.end(), [&](const ShootingNode& node) {
    return node.parent == taken.parent && node.event.before.position == taken.event.before.position;
  }));
  const auto& first = path[0].event.before.position;
  EXPECT_TRUE(
      std::any_of(search_->kept(0).begin(), search_->kept(0).end(),
                  [&](const ShootingNode& node) { return node.event.before.position == first; }));
}

}  // namespace
}  // namespace ifa
