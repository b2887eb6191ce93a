// SPDX-License-Identifier: Apache-2.0
// How long work tells how far it is, and is told to stop.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace ifa {

/// Handed down to anything that may take long. Thread safe as far as `stopRequested` goes; `report`
/// is called from one thread at a time.
struct Progress {
  /// Called with a stage's name and its share done, 0 to 1. May be empty.
  std::function<void(std::string_view stage, double share)> report;
  /// Set from outside (a signal handler, a page that went away) to ask for an early, clean end.
  const std::atomic<bool>* stop = nullptr;

  [[nodiscard]] bool stopRequested() const {
    return stop != nullptr && stop->load(std::memory_order_relaxed);
  }
  void operator()(std::string_view stage, double share) const {
    if (report) report(stage, share);
  }
};

}  // namespace ifa
