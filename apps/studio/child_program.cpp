// SPDX-License-Identifier: Apache-2.0
#include "studio/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <optional>

#include "base/sanitized.h"

namespace ifa::studio {
namespace {

constexpr std::size_t kMaxText = 64 << 10;
constexpr int kTick = 100;  // ms between two questions whether to go on

void limit(__rlimit_resource what, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(what, &both);
}

/// Only calls that are safe after a fork of a process with threads.
[[noreturn]] void become(const char* program, char* const* arguments, int out, int err) {
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, 600);
  limit(RLIMIT_FSIZE, rlim_t{1} << 30);
#ifndef IFA_SANITIZED  // these reserve terabytes
  limit(RLIMIT_AS, rlim_t{8} << 30);
#endif
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  ::execv(program, arguments);
  ::_exit(127);
}

struct Running {
  pid_t process = -1;
  int out = -1, err = -1;
};

Running start(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  std::array<int, 2> out{-1, -1}, err{-1, -1};
  Running running;
  if (::pipe2(out.data(), O_CLOEXEC) == 0 && ::pipe2(err.data(), O_CLOEXEC) == 0) {
    running.process = ::fork();
    if (running.process == 0) become(program.c_str(), words.data(), out[1], err[1]);
    running.out = out[0];
    running.err = err[0];
  } else if (out[0] >= 0) {
    ::close(out[0]);
  }
  for (const int end : {out[1], err[1]}) {
    if (end >= 0) ::close(end);
  }
  return running;
}

/// One block of what has come; none at the end of the stream.
std::optional<std::string_view> readSome(int stream, std::array<char, 4096>& block) {
  const ssize_t count = ::read(stream, block.data(), block.size());
  if (count > 0) return std::string_view(block.data(), static_cast<std::size_t>(count));
  return count < 0 && errno == EINTR ? std::optional(std::string_view()) : std::nullopt;
}

/// Hands whole lines on; what is longer than kMaxText is cut off.
class Lines {
 public:
  explicit Lines(const std::function<void(std::string_view)>& line) : line_(line) {}
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      if (byte == '\n') {
        line_(text_);
        text_.clear();
      } else if (text_.size() < kMaxText) {
        text_ += byte;
      }
    }
  }

 private:
  const std::function<void(std::string_view)>& line_;
  std::string text_;
};

/// Until both streams have ended. False where it was told to stop.
bool follow(const Running& running, const ChildWatcher& watcher, std::string& output) {
  std::array<pollfd, 2> streams = {pollfd{running.out, POLLIN, 0}, pollfd{running.err, POLLIN, 0}};
  std::array<char, 4096> block{};
  Lines lines(watcher.line);
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (!watcher.goOn()) return false;
    if (::poll(streams.data(), streams.size(), kTick) <= 0) continue;
    if (streams[0].revents != 0) {
      const auto bytes = readSome(running.out, block);
      if (!bytes) streams[0].fd = -1;
      if (bytes) output.append(bytes->substr(0, kMaxText - std::min(kMaxText, output.size())));
    }
    if (streams[1].revents != 0) {
      const auto bytes = readSome(running.err, block);
      if (!bytes) streams[1].fd = -1;
      if (bytes) lines.add(*bytes);
    }
  }
  return true;
}

}  // namespace

ChildEnd runChild(const std::string& program, const std::vector<std::string>& arguments,
                  const ChildWatcher& watcher) {
  ChildEnd end;
  const Running running = start(program, arguments);
  const bool whole = running.process > 0 && follow(running, watcher, end.output);
  if (running.process > 0 && !whole) ::kill(running.process, SIGKILL);
  for (const int stream : {running.out, running.err}) {
    if (stream >= 0) ::close(stream);
  }
  if (running.process <= 0) return end;
  int status = 0;
  while (::waitpid(running.process, &status, 0) < 0 && errno == EINTR) {
  }
  end.kind = !whole              ? ChildEnd::Kind::kCancelled
             : WIFEXITED(status) ? ChildEnd::Kind::kExited
                                 : ChildEnd::Kind::kCrashed;
  if (WIFEXITED(status)) end.code = WEXITSTATUS(status);
  return end;
}

std::string thisProgram() {
  std::array<char, 4096> path{};
  const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size());
  return length > 0 ? std::string(path.data(), static_cast<std::size_t>(length)) : std::string();
}

}  // namespace ifa::studio
