// SPDX-License-Identifier: Apache-2.0
#include "base/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace ifa {
namespace {

TEST(StopwatchTest, SleepTakesTimeOfTheClockAndNoneOfTheThread) {
  const Stopwatch clock, thread(TimeOf::kThread);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GE(clock.seconds(), 0.05);
  EXPECT_LT(thread.seconds(), 0.02);
}

TEST(StopwatchTest, WorkTakesBoth) {
  const Stopwatch clock, thread(TimeOf::kThread);
  while (thread.seconds() < 0.02) {
  }
  EXPECT_GE(clock.seconds(), 0.0199);
}

}  // namespace
}  // namespace ifa
