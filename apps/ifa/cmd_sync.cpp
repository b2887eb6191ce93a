// SPDX-License-Identifier: Apache-2.0
// `ifa sync`: sound in, synchronised motion out.
#include "command.h"

namespace ifa::cli {

void addSyncCommand(CLI::App& app, CommandContext& context) {
  static_cast<void>(app);
  static_cast<void>(context);
}

}  // namespace ifa::cli
