// SPDX-License-Identifier: Apache-2.0
// A job of the studio: this program once more, as a process of its own, so that what crashes, hangs
// or takes too much memory there does not take the studio with it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ifa::studio {

/// How a job ended.
struct ChildEnd {
  enum class Kind { kExited, kCrashed, kCancelled, kNotStarted };
  Kind kind = Kind::kNotStarted;
  int code = -1;       ///< the exit code, where it exited
  std::string output;  ///< the first 64 KiB of its stdout
};

/// Whom to tell, and whether to go on.
struct ChildWatcher {
  std::function<void(std::string_view)> line;  ///< each line of stderr, without its end
  std::function<bool()> goOn;                  ///< asked several times a second; false kills it
};

/// Runs `program arguments...` to its end, within bounds: ten minutes of processor time, 8 GiB of
/// memory, 1 GiB for a file; lines of at most 64 KiB. It dies with the calling thread.
[[nodiscard]] ChildEnd runChild(const std::string& program,
                                const std::vector<std::string>& arguments,
                                const ChildWatcher& watcher);

/// The running program's own file.
[[nodiscard]] std::string thisProgram();

}  // namespace ifa::studio
