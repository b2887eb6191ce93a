// SPDX-License-Identifier: Apache-2.0
// Runs the program that was built, as a user's shell would.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ifa::test {

struct ProgramResult {
  int exit = -1;  ///< -1 when it died of a signal
  std::string out, err;
};

/// Runs `ifa arguments...` to its end, without a stdin.
ProgramResult runProgram(const std::vector<std::string>& arguments);

/// Runs it, and sends it `signal` once it has written `text` to stderr (or after ten seconds).
ProgramResult runAndSignal(const std::vector<std::string>& arguments, const std::string& text,
                           int signal);

/// Runs it and kills it (SIGKILL) after `seconds`, if it is not done by then.
ProgramResult runAndKill(const std::vector<std::string>& arguments, double seconds);

/// Runs it where no file may grow larger than `bytes`, as on a disk that is full.
ProgramResult runWithLargestFile(const std::vector<std::string>& arguments, std::uint64_t bytes);

/// The lines of a text that are not empty.
std::vector<std::string> linesOf(const std::string& text);

}  // namespace ifa::test
