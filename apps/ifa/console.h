// SPDX-License-Identifier: Apache-2.0
// The two streams of the command line: results on stdout, everything else on stderr.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "ifa/result.h"

namespace ifa::cli {

/// Thread safe. With JSON lines on, stderr carries one JSON object a line, flushed (docs/cli.md);
/// otherwise text, with one progress line that is redrawn where stderr is a terminal.
class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void setJsonLines(bool on) { jsonLines_ = on; }

  /// What the user asked for: to stdout, with a newline.
  void result(std::string_view text);
  /// Worth knowing, to stderr.
  void log(std::string_view text);
  /// Something that the user should look at, to stderr.
  void warn(std::string_view text);
  /// @param share  of the stage that is done, 0 to 1
  void progress(std::string_view stage, double share);
  /// The failure in full, to stderr.
  void failure(const Error& error);
  /// To stderr, JSON lines only.
  void success(std::string_view output);

 private:
  using Clock = std::chrono::steady_clock;

  void drawProgress(std::string_view stage, double share);
  void clearProgress();
  void line(std::string_view kind, std::string_view text);

  std::mutex mutex_;
  bool jsonLines_ = false;
  bool terminal_ = false;  ///< stderr is one
  bool drawn_ = false;     ///< a progress line is on the screen
  std::string stage_;
  Clock::time_point stageStart_, lastDrawn_;
  double lastShare_ = -1;
  double firstShare_ = 0;  ///< of the stage: work that is resumed does not begin at 0
};

}  // namespace ifa::cli
