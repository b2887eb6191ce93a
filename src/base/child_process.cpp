// SPDX-License-Identifier: Apache-2.0
#include "base/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <fstream>
#include <string_view>

#include "base/write_all.h"

namespace ifa {
namespace {

constexpr int kFailed = 1;

/// Bytes of data that this process has mapped (proc(5), statm).
std::uint64_t mappedData() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages = 0;
  for (int field = 0; field < 6; ++field) statm >> pages;
  return statm ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// Whoever watches over this process must not take the child's end for its own.
void becomeChild(double seconds, std::uint64_t bytes) {
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTRAP, SIGPROF, SIGTERM}) {
    ::signal(signal, SIG_DFL);
  }
  ::signal(SIGPIPE, SIG_IGN);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit core{0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  const rlimit data{bytes, RLIM_INFINITY};
  ::setrlimit(RLIMIT_DATA, &data);
  itimerval left{};  // of processor time; its signal ends the process
  left.it_value.tv_sec = static_cast<time_t>(seconds);
  left.it_value.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
  ::setitimer(ITIMER_PROF, &left, nullptr);
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0) ::dup2(nothing, STDERR_FILENO);
}

[[noreturn]] void work(const std::function<std::string()>& what, int file, double seconds,
                       std::uint64_t bytes) {
  becomeChild(seconds, bytes);
  int code = kFailed;
  try {
    if (writeAll(file, what())) code = 0;
  } catch (...) {
    code = kFailed;
  }
  // Not exit: what this process would do at its end is for the parent to do.
  ::_exit(code);
}

std::string readAll(int file) {
  std::string bytes;
  std::array<char, 1 << 16> block{};
  for (;;) {
    const ssize_t count = ::read(file, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::optional<std::string> callInChild(const std::function<std::string()>& what, double seconds,
                                       std::uint64_t bytes) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  const std::uint64_t most = mappedData() + bytes;
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    work(what, ends[1], seconds, most);
  }
  ::close(ends[1]);
  std::string returned;
  if (child > 0) returned = readAll(ends[0]);
  ::close(ends[0]);
  int status = -1;
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (child < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return returned;
}

}  // namespace ifa
