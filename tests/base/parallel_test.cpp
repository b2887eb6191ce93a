// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "base/random.h"

namespace ifa {
namespace {

std::vector<double> work() {
  std::vector<double> values(5000);
  parallelFor(values.size(), [&](std::size_t i) {
    RandomStream stream(3, i);
    for (int draw = 0; draw < 50; ++draw) values[i] += stream.uniform();
  });
  return values;
}

class ParallelFor : public testing::Test {
 protected:
  void TearDown() override { setThreadCount(0); }
};

TEST_F(ParallelFor, GivesTheSameBitsForAnyNumberOfThreads) {
  setThreadCount(1);
  const auto one = work();
  for (const int threads : {2, 3, 8}) {
    setThreadCount(threads);
    EXPECT_EQ(work(), one) << threads << " threads";
  }
}

TEST_F(ParallelFor, VisitsEveryIndexOnce) {
  std::vector<std::atomic<int>> visits(10007);
  parallelFor(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const auto& count : visits) ASSERT_EQ(count, 1);
}

TEST_F(ParallelFor, OfNothingCallsNothing) {
  bool called = false;
  parallelFor(0, [&](std::size_t) { called = true; });
  EXPECT_FALSE(called);
}

TEST_F(ParallelFor, TellsHowFarItIsAndIsStopped) {
  std::atomic<bool> stop{false};
  std::vector<double> shares;
  const Progress progress{[&](std::string_view stage, double share) {
                            EXPECT_EQ(stage, "drops");
                            shares.push_back(share);
                            stop = share > 0.3;
                          },
                          &stop};
  std::vector<std::atomic<int>> visits(1000);
  parallelFor(visits.size(), "drops", progress, [&](std::size_t i) { ++visits[i]; });
  ASSERT_GT(shares.size(), 2);
  EXPECT_EQ(shares.front(), 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(visits.front(), 1);
  EXPECT_EQ(visits.back(), 0);
}

TEST_F(ParallelFor, PassesAnExceptionToTheCaller) {
  const auto failing = [] {
    parallelFor(100, [](std::size_t i) {
      if (i == 57) throw std::runtime_error("57");
    });
  };
  EXPECT_THROW(failing(), std::runtime_error);
}

class MakeInOrder : public ParallelFor {};

TEST_F(MakeInOrder, TakesEverythingInOrderOneAtATime) {
  for (const int threads : {1, 2, 4}) {
    setThreadCount(threads);
    std::vector<double> made(300);
    std::vector<std::size_t> taken;
    std::atomic<int> taking{0};
    makeInOrder(
        made.size(), 8,
        [&](std::size_t i) {
          RandomStream stream(3, i);
          // Some take much longer than others.
          for (std::size_t draw = 0; draw < (i % 7) * 300; ++draw) made[i] += stream.uniform();
          made[i] += 1;
        },
        [&](std::size_t i) {
          EXPECT_EQ(++taking, 1);
          EXPECT_GT(made[i], 0) << "made before it is taken";
          taken.push_back(i);
          --taking;
          return true;
        });
    ASSERT_EQ(taken.size(), made.size()) << threads << " threads";
    for (std::size_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i);
  }
}

TEST_F(MakeInOrder, RunsNoFurtherAheadThanItMay) {
  constexpr std::size_t kAhead = 3;
  std::atomic<std::size_t> taken{0}, furthest{0};
  std::vector<std::atomic<int>> places(kAhead);
  makeInOrder(
      200, kAhead,
      [&](std::size_t i) {
        EXPECT_LT(i, taken + kAhead);
        furthest = std::max(furthest.load(), i - taken);
        EXPECT_EQ(++places[i % kAhead], 1) << "a place is free when it is used again";
      },
      [&](std::size_t i) {
        --places[i % kAhead];
        ++taken;
        return true;
      });
  EXPECT_EQ(taken, 200u);
  EXPECT_LT(furthest, kAhead);
}

TEST_F(MakeInOrder, EndsWhenItIsToldTo) {
  std::atomic<std::size_t> made{0};
  std::vector<std::size_t> taken;
  makeInOrder(
      100000, 4, [&](std::size_t) { ++made; },
      [&](std::size_t i) {
        taken.push_back(i);
        return i < 10;
      });
  ASSERT_EQ(taken.size(), 11u);
  EXPECT_EQ(taken.back(), 10u);
  EXPECT_LE(made, 11u + 4u);
}

TEST_F(MakeInOrder, OfNothingCallsNothing) {
  bool called = false;
  makeInOrder(
      0, 4, [&](std::size_t) { called = true; },
      [&](std::size_t) {
        called = true;
        return true;
      });
  EXPECT_FALSE(called);
}

TEST_F(MakeInOrder, PassesExceptionsToTheCaller) {
  const auto making = [] {
    makeInOrder(
        100, 4,
        [](std::size_t i) {
          if (i == 57) throw std::runtime_error("57");
        },
        [](std::size_t) { return true; });
  };
  EXPECT_THROW(making(), std::runtime_error);
  std::size_t last = 0;
  const auto taking = [&] {
    makeInOrder(
        100, 4, [](std::size_t) {},
        [&](std::size_t i) -> bool {
          last = i;
          if (i == 23) throw std::runtime_error("23");
          return true;
        });
  };
  EXPECT_THROW(taking(), std::runtime_error);
  EXPECT_EQ(last, 23u);
}

}  // namespace
}  // namespace ifa
