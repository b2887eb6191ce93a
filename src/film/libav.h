// SPDX-License-Identifier: Apache-2.0
// libav's objects as C++ ones, and its errors as ours. Included only where IFA_WITH_FILM is set.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswresample/swresample.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>

#include "ifa/result.h"

namespace ifa {

struct LibavDeleter {
  void operator()(AVCodecContext* it) const { avcodec_free_context(&it); }
  void operator()(AVFormatContext* it) const { avformat_free_context(it); }
  void operator()(AVFrame* it) const { av_frame_free(&it); }
  void operator()(AVPacket* it) const { av_packet_free(&it); }
  void operator()(SwsContext* it) const { sws_freeContext(it); }
  void operator()(SwrContext* it) const { swr_free(&it); }
  void operator()(AVIOContext* it) const {
    av_freep(static_cast<void*>(&it->buffer));
    avio_context_free(&it);
  }
};

template <class T>
using LibavPtr = std::unique_ptr<T, LibavDeleter>;

/// From now on libav prints nothing: what it has to say of errors goes into `libavError`. Replaces
/// the log callback of the whole process, as libav has no other. Thread safe.
void keepLibavQuiet();

/// kInternal: `what` with libav's text for `code` and what this thread's last calls complained of.
[[nodiscard]] tl::unexpected<Error> libavError(const std::string& what, int code);

}  // namespace ifa
