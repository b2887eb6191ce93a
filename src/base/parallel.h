// SPDX-License-Identifier: Apache-2.0
// The one loop over independent items that uses all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace ifa {

/// Calls `body(i)` for every i in [0, count) on the worker threads. Each call writes only what
/// belongs to i, so that the result does not depend on the number of threads. Exceptions pass to
/// the caller.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// Limits the number of worker threads from now on; 0 means one per core. For tests and
/// `--threads`.
void setThreadCount(int count);

}  // namespace ifa
