// SPDX-License-Identifier: Apache-2.0
#include "base/stopwatch.h"

#include <ctime>

namespace ifa {

namespace {

double now(TimeOf what) {
  timespec time{};
  clock_gettime(what == TimeOf::kThread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Stopwatch::Stopwatch(TimeOf what) : what_(what), begin_(now(what)) {}

double Stopwatch::seconds() const { return now(what_) - begin_; }

}  // namespace ifa
