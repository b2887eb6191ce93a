// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace ifa::cli {

namespace {

using Json = nlohmann::ordered_json;

void writeLine(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fputc('\n', stream);
  std::fflush(stream);
}

// What names of files and faces hold is told, not done: no colours, no moved cursor.
std::string printable(std::string_view text) {
  std::string all;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
    all += control ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return all;
}

// A file name may hold any bytes; a line of JSON may not.
void writeJson(const Json& json) {
  writeLine(stderr, json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string remainingTime(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s left", seconds);
  const auto whole = static_cast<long>(seconds);
  return fmt::format("{} min {:02} s left", whole / 60, whole % 60);
}

}  // namespace

Console::Console() : terminal_(::isatty(STDERR_FILENO) != 0) {}

Console::~Console() { clearProgress(); }

void Console::result(std::string_view text) {
  const std::scoped_lock lock(mutex_);
  clearProgress();
  writeLine(stdout, text);
}

void Console::log(std::string_view text) { line("info", text); }

void Console::warn(std::string_view text) { line("warning", text); }

void Console::line(std::string_view kind, std::string_view text) {
  const std::scoped_lock lock(mutex_);
  if (jsonLines_) {
    writeJson({{"type", "log"}, {"level", kind}, {"message", text}});
    return;
  }
  clearProgress();
  writeLine(stderr, printable(kind == "info" ? text : fmt::format("{}: {}", kind, text)));
}

void Console::progress(std::string_view stage, double share) {
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  const bool newStage = stage != stage_;
  if (newStage) {
    stage_ = stage;
    stageStart_ = now;
    firstShare_ = share;
    lastShare_ = -1;
  }
  // A reader wants to see it move, not every step of a search.
  const bool soon = now - lastDrawn_ < std::chrono::milliseconds(jsonLines_ ? 50 : 100);
  if (share < 1 && !newStage && (soon || share == lastShare_)) return;
  if (share == lastShare_) return;
  lastShare_ = share;
  lastDrawn_ = now;
  if (jsonLines_) {
    writeJson({{"type", "progress"}, {"stage", stage}, {"value", share}});
  } else if (terminal_) {
    drawProgress(stage, share);
  }
}

void Console::drawProgress(std::string_view stage, double share) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - stageStart_).count();
  std::string text = fmt::format("\r{} {:3.0f} %", stage, 100 * share);
  const double done = share - firstShare_;
  if (done > 0.02 * (1 - firstShare_) && share < 1 && elapsed > 0.5) {
    text += ", " + remainingTime(elapsed * (1 - share) / done);
  }
  text += "\x1b[K";
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Console::clearProgress() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void Console::failure(const Error& error) {
  const std::scoped_lock lock(mutex_);
  if (jsonLines_) {
    writeJson({{"type", "failure"},
               {"code", static_cast<int>(error.code)},
               {"message", error.message},
               {"place", error.place},
               {"remedy", error.remedy}});
    return;
  }
  clearProgress();
  writeLine(stderr, printable("ifa: " + error.text()));
}

void Console::success(std::string_view output) {
  const std::scoped_lock lock(mutex_);
  if (jsonLines_) writeJson({{"type", "success"}, {"output", output}});
}

}  // namespace ifa::cli
