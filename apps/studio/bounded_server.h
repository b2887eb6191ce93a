// SPDX-License-Identifier: Apache-2.0
// cpp-httplib's server with what it lacks: bounds on the time and the bytes that a client may take
// before anything is known of its request, and one request a connection.
#pragma once

#include <chrono>
#include <cstddef>

#include "studio/http.h"

namespace ifa::studio {

/// What a client may take.
struct ConnectionLimits {
  std::size_t headBytes = 32 << 10;            ///< of the request line and all headers
  std::chrono::milliseconds headTime{5000};    ///< from the connection to the end of the headers
  std::chrono::milliseconds bodyTime{60000};   ///< for the body, once it was allowed
  std::chrono::milliseconds writeTime{10000};  ///< for each block of the answer
  std::size_t lingerBytes = 1 << 20;           ///< taken of what a refused client still sends
  std::chrono::milliseconds lingerTime{500};   ///< for what a refused client still sends
};

/// The connection that the calling thread serves.
class Connection {
 public:
  virtual ~Connection() = default;
  /// Lets `bytes` more be read, within the time of a body. Until then a request has its head only.
  virtual void allowBody(std::size_t bytes) = 0;
  /// False once the client has closed it.
  [[nodiscard]] virtual bool alive() const = 0;

  /// None where no request is being served by this thread.
  [[nodiscard]] static Connection* current();
};

/// A connection that is kept would take the unread body of a refused request for the next request,
/// headers and all; so none is kept.
class BoundedServer : public httplib::Server {
 public:
  explicit BoundedServer(const ConnectionLimits& limits = {}) : limits_(limits) {}

  /// Bound, lets more than the library's five connections wait to be accepted.
  void queueConnections() const;

 private:
  bool process_and_close_socket(socket_t socket) override;

  ConnectionLimits limits_;
};

}  // namespace ifa::studio
