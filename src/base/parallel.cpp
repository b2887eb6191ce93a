// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <atomic>
#include <memory>

namespace ifa {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  // One at a time: what is done here takes long, and some of it a hundred times as long as the
  // rest.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
}

void parallelFor(std::size_t count, std::string_view stage, const Progress& progress,
                 const std::function<void(std::size_t)>& body) {
  constexpr std::size_t kTold = 50;  // calls between two reports
  for (std::size_t begin = 0; begin < count && !progress.stopRequested(); begin += kTold) {
    progress(stage, static_cast<double>(begin) / static_cast<double>(count));
    parallelFor(std::min(kTold, count - begin), [&](std::size_t i) { body(begin + i); });
  }
}

void makeInOrder(std::size_t count, std::size_t ahead, const std::function<void(std::size_t)>& make,
                 const std::function<bool(std::size_t)>& take) {
  std::size_t next = 0;
  std::atomic<bool> stopped{false};
  const auto begin = [&](tbb::flow_control& control) {
    if (next == count || stopped) control.stop();
    return next++;
  };
  const auto work = [&](std::size_t i) {
    if (!stopped) make(i);
    return i;
  };
  const auto finish = [&](std::size_t i) {
    if (!stopped && !take(i)) stopped = true;
  };
  using Mode = tbb::filter_mode;
  tbb::parallel_pipeline(ahead,
                         tbb::make_filter<void, std::size_t>(Mode::serial_in_order, begin) &
                             tbb::make_filter<std::size_t, std::size_t>(Mode::parallel, work) &
                             tbb::make_filter<std::size_t, void>(Mode::serial_in_order, finish));
}

void setThreadCount(int count) {
  static std::unique_ptr<tbb::global_control> control;
  control.reset();
  if (count > 0) {
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
  }
}

}  // namespace ifa
