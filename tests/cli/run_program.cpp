// SPDX-License-Identifier: Apache-2.0
#include "run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace ifa::test {

namespace {

struct Running {
  pid_t process = -1;
  int out = -1, err = -1;
};

[[noreturn]] void becomeProgram(const std::vector<std::string>& arguments) {
  std::vector<char*> words = {const_cast<char*>(IFA_PROGRAM)};
  for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execv(IFA_PROGRAM, words.data());
  ::_exit(127);
}

Running start(const std::vector<std::string>& arguments, rlim_t largestFile = RLIM_INFINITY) {
  std::array<int, 2> out{}, err{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::dup2(err[1], STDERR_FILENO);
    const rlimit limit = {largestFile, largestFile};
    if (largestFile != RLIM_INFINITY) ::setrlimit(RLIMIT_FSIZE, &limit);
    becomeProgram(arguments);
  }
  ::close(out[1]);
  ::close(err[1]);
  return {process, out[0], err[0]};
}

// One block of what has come; false at the end of the stream.
bool readSome(int stream, std::string& text) {
  std::array<char, 4096> block{};
  const ssize_t count = ::read(stream, block.data(), block.size());
  if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
  return count > 0;
}

template <class Heard>
ProgramResult follow(const Running& running, Heard heard) {
  ProgramResult result;
  std::array<pollfd, 2> streams = {pollfd{running.out, POLLIN, 0}, pollfd{running.err, POLLIN, 0}};
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    const int ready = ::poll(streams.data(), streams.size(), 10000);
    if (streams[0].revents != 0 && !readSome(running.out, result.out)) streams[0].fd = -1;
    if (streams[1].revents != 0 && !readSome(running.err, result.err)) streams[1].fd = -1;
    heard(result, ready == 0);
  }
  ::close(running.out);
  ::close(running.err);
  int status = 0;
  ::waitpid(running.process, &status, 0);
  if (WIFEXITED(status)) result.exit = WEXITSTATUS(status);
  return result;
}

}  // namespace

ProgramResult runProgram(const std::vector<std::string>& arguments) {
  return follow(start(arguments), [](const ProgramResult&, bool) {});
}

ProgramResult runAndSignal(const std::vector<std::string>& arguments, const std::string& text,
                           int signal) {
  const Running running = start(arguments);
  bool sent = false;
  return follow(running, [&](const ProgramResult& result, bool late) {
    if (sent || (!late && result.err.find(text) == std::string::npos)) return;
    ::kill(running.process, signal);
    sent = true;
  });
}

ProgramResult runAndKill(const std::vector<std::string>& arguments, double seconds) {
  const Running running = start(arguments);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  ::kill(running.process, SIGKILL);
  return follow(running, [](const ProgramResult&, bool) {});
}

ProgramResult runWithLargestFile(const std::vector<std::string>& arguments, std::uint64_t bytes) {
  return follow(start(arguments, bytes), [](const ProgramResult&, bool) {});
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

}  // namespace ifa::test
