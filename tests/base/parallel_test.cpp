// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
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

TEST_F(ParallelFor, PassesAnExceptionToTheCaller) {
  const auto failing = [] {
    parallelFor(100, [](std::size_t i) {
      if (i == 57) throw std::runtime_error("57");
    });
  };
  EXPECT_THROW(failing(), std::runtime_error);
}

}  // namespace
}  // namespace ifa
