// SPDX-License-Identifier: Apache-2.0
// The one loop over independent items that uses all cores.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "base/progress.h"

namespace ifa {

/// Calls `body(i)` for every i in [0, count) on the worker threads. Each call writes only what
/// belongs to i, so that the result does not depend on the number of threads. Exceptions pass to
/// the caller.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same, and tells `progress` under `stage` how far it is. Asked to stop, it leaves
/// out what it has not begun.
void parallelFor(std::size_t count, std::string_view stage, const Progress& progress,
                 const std::function<void(std::size_t)>& body);

/// Calls `make(i)` for i in [0, count) on the worker threads and `take(i)` for each in order, one
/// at a time. At most `ahead` indices are made and not yet taken, and these follow each other, so
/// that `ahead` places are enough for what is made. Ends early when `take` returns false.
/// Exceptions pass to the caller.
void makeInOrder(std::size_t count, std::size_t ahead, const std::function<void(std::size_t)>& make,
                 const std::function<bool(std::size_t)>& take);

/// Limits the number of worker threads from now on; 0 means one per core. For tests and
/// `--threads`.
void setThreadCount(int count);

}  // namespace ifa
