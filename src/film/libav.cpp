// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/libav.h"

#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace ifa {

namespace {

// Encoders run in the thread that calls them (video_stream.cpp), so their complaints stay with it.
thread_local std::string complaint;

void collect(void* /*object*/, int level, const char* format, va_list arguments) {
  if (level > AV_LOG_ERROR) return;
  char line[512];
  std::vsnprintf(line, sizeof line, format, arguments);
  complaint = line;
  while (!complaint.empty() && complaint.back() == '\n') complaint.pop_back();
}

}  // namespace

void keepLibavQuiet() {
  static std::once_flag once;
  std::call_once(once, [] { av_log_set_callback(collect); });
  complaint.clear();
}

tl::unexpected<Error> libavError(const std::string& what, int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  std::string message = what + ": " + text;
  if (!complaint.empty()) message += ", " + complaint;
  complaint.clear();
  return tl::unexpected<Error>(Error{ErrorCode::kInternal, std::move(message), "libav", {}});
}

}  // namespace ifa
#endif
