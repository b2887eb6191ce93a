// SPDX-License-Identifier: Apache-2.0
// Keeps libraries from writing to stderr, where they cannot be told to.
#pragma once

namespace ifa {

/// While one of these lives, what the process writes to stderr is thrown away: libmpg123, which
/// libsndfile reads MP3 with, prints a line for every broken frame. Thread safe; where stderr
/// cannot be redirected it stays as it is.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
};

}  // namespace ifa
