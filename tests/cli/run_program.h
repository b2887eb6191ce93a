// SPDX-License-Identifier: Apache-2.0
// Runs the program that was built, as a user's shell would.
#pragma once

#include <sys/types.h>

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

/// The lines of a text that are not empty.
std::vector<std::string> linesOf(const std::string& text);

}  // namespace ifa::test
