// SPDX-License-Identifier: Apache-2.0
// Seconds since something began.
#pragma once

namespace ifa {

/// Whose seconds are counted.
enum class TimeOf {
  kClock,   ///< steady wall time
  kThread,  ///< processor time of the thread that asks; other work on the machine does not count
};

/// Counts from its making. With kThread made and asked by one thread only.
class Stopwatch {
 public:
  explicit Stopwatch(TimeOf what = TimeOf::kClock);

  /// Seconds, to a microsecond or better.
  [[nodiscard]] double seconds() const;

 private:
  TimeOf what_;
  double begin_;
};

}  // namespace ifa
