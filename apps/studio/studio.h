// SPDX-License-Identifier: Apache-2.0
// The local web studio: what it answers (docs/studio.md, docs/security.md).
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "ifa/result.h"
#include "studio/bounded_server.h"
#include "studio/child_program.h"
#include "studio/pages.h"

namespace ifa::studio {

struct StudioSettings {
  std::string host = "127.0.0.1";  ///< address to listen at
  int port = 0;                    ///< 0: any that is free
  std::filesystem::path folder;    ///< of the sessions
  Pages pages;
  std::string program = thisProgram();  ///< that does the jobs
  std::size_t jobs = 2;                 ///< that run at a time
  std::size_t waitingJobs = 16;         ///< more are refused
  std::size_t connections = 64;         ///< answered at a time; others wait
  ConnectionLimits limits;
};

/// Listens from the constructor's end on, answers while `run` runs.
class Studio {
 public:
  /// Errors: kBadInput where the port is taken, the folder cannot be made or there is no library.
  [[nodiscard]] static Result<std::unique_ptr<Studio>> open(StudioSettings settings);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  [[nodiscard]] int port() const;
  /// Answers until `stop`.
  void run();
  /// From any thread: ends the jobs, then `run`.
  void stop();

 private:
  class Server;
  explicit Studio(std::unique_ptr<Server> server);
  std::unique_ptr<Server> server_;
};

}  // namespace ifa::studio
