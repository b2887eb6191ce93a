// SPDX-License-Identifier: Apache-2.0
// Synchronising one sound of many, with what they share.
#pragma once

#include "ifa/synchronize.h"
#include "pipeline/object_graph.h"

namespace ifa {

/// As synchronize(); graphs are taken from `shelf`, whose options are taken for those of
/// `settings`.
[[nodiscard]] Result<Synchronization> synchronizeWith(const SynchronizeSettings& settings,
                                                      GraphShelf& shelf, const Progress& progress);

}  // namespace ifa
