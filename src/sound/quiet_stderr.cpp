// SPDX-License-Identifier: Apache-2.0
#include "sound/quiet_stderr.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

namespace ifa {

namespace {

std::mutex mutex;
int living = 0;  // guarded by the mutex, as is what follows
int saved = -1;  // the true stderr; -1 where it was not redirected

}  // namespace

QuietStderr::QuietStderr() {
  const std::lock_guard lock(mutex);
  if (living++ > 0) return;
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing < 0) return;
  saved = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (saved >= 0) ::dup2(nothing, STDERR_FILENO);
  ::close(nothing);
}

QuietStderr::~QuietStderr() {
  const std::lock_guard lock(mutex);
  if (--living > 0 || saved < 0) return;
  ::dup2(saved, STDERR_FILENO);
  ::close(saved);
  saved = -1;
}

}  // namespace ifa
