// SPDX-License-Identifier: Apache-2.0
// The options of planner "graph", for every command that plans.
#pragma once

#include <CLI/CLI.hpp>

#include "ifa/synchronize.h"

namespace ifa::cli {

/// @param options  outlives the command
void addGraphOptions(CLI::App& command, GraphOptions& options);

}  // namespace ifa::cli
