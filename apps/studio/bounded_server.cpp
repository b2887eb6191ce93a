// SPDX-License-Identifier: Apache-2.0
#include "studio/bounded_server.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace ifa::studio {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

thread_local Connection* served = nullptr;

/// Waits for `events` until the deadline. False where it has passed.
bool waitFor(socket_t socket, short events, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd one{socket, events, 0};
    const int ready = ::poll(&one, 1, static_cast<int>(std::min<long long>(left, 60000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

void addressOf(const sockaddr_storage& address, socklen_t length, std::string& ip, int& port) {
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  if (::getnameinfo(any, length, host.data(), host.size(), service.data(), service.size(),
                    NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
    return;
  }
  ip = host.data();
  port = std::atoi(service.data());
}

class BoundedStream final : public httplib::Stream, public Connection {
 public:
  BoundedStream(socket_t socket, const ConnectionLimits& limits)
      : socket_(socket),
        limits_(limits),
        left_(limits.headBytes),
        deadline_(Clock::now() + limits.headTime) {
    served = this;
  }
  ~BoundedStream() override { served = nullptr; }
  BoundedStream(const BoundedStream&) = delete;
  BoundedStream& operator=(const BoundedStream&) = delete;

  void allowBody(std::size_t bytes) override {
    left_ = bytes;
    deadline_ = Clock::now() + limits_.bodyTime;
  }

  [[nodiscard]] bool alive() const override {
    char byte = 0;
    const ssize_t count = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
  }

  [[nodiscard]] bool is_readable() const override {
    return next_ < filled_ || waitFor(socket_, POLLIN, deadline_);
  }
  [[nodiscard]] bool is_writable() const override {
    return alive() && waitFor(socket_, POLLOUT, Clock::now() + limits_.writeTime);
  }

  ssize_t read(char* bytes, std::size_t size) override {
    size = std::min(size, left_);
    if (size == 0 || (next_ == filled_ && !fill())) return -1;
    size = std::min(size, filled_ - next_);
    std::memcpy(bytes, block_.data() + next_, size);
    next_ += size;
    left_ -= size;
    return static_cast<ssize_t>(size);
  }

  ssize_t write(const char* bytes, std::size_t size) override {
    if (!waitFor(socket_, POLLOUT, Clock::now() + limits_.writeTime)) return -1;
    // Not more at a time than goes without waiting: the socket blocks.
    const ssize_t sent = ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent < 0 && errno == EAGAIN ? 0 : sent;
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    sockaddr_storage address{};
    socklen_t length = sizeof(address);
    if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0) {
      addressOf(address, length, ip, port);
    }
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    sockaddr_storage address{};
    socklen_t length = sizeof(address);
    if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0) {
      addressOf(address, length, ip, port);
    }
  }
  [[nodiscard]] socket_t socket() const override { return socket_; }

  /// Closes, but first takes a little of what is still coming: what lies unread in the socket would
  /// reset the connection, and the client would not see why it was refused.
  void close() {
    ::shutdown(socket_, SHUT_WR);
    const auto end = Clock::now() + limits_.lingerTime;
    for (std::size_t taken = 0; taken < limits_.lingerBytes && waitFor(socket_, POLLIN, end);) {
      const ssize_t count = ::recv(socket_, block_.data(), block_.size(), 0);
      if (count <= 0) break;
      taken += static_cast<std::size_t>(count);
    }
    ::close(socket_);
  }

 private:
  bool fill() {
    if (!waitFor(socket_, POLLIN, deadline_)) return false;
    const ssize_t count = ::recv(socket_, block_.data(), block_.size(), 0);
    if (count <= 0) return false;
    next_ = 0;
    filled_ = static_cast<std::size_t>(count);
    return true;
  }

  socket_t socket_;
  ConnectionLimits limits_;
  std::size_t left_;  ///< bytes that may still be read
  Clock::time_point deadline_;
  std::array<char, 1 << 14> block_{};
  std::size_t next_ = 0, filled_ = 0;
};

}  // namespace

Connection* Connection::current() { return served; }

void BoundedServer::queueConnections() const { ::listen(svr_sock_, 256); }

bool BoundedServer::process_and_close_socket(socket_t socket) {
  BoundedStream stream(socket, limits_);
  bool closed = false;
  const bool good = process_request(stream, true, closed, nullptr);
  stream.close();
  return good;
}

}  // namespace ifa::studio
