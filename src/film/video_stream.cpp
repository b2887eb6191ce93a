// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/video_stream.h"

#include <cerrno>
#include <cstring>

#include "film/video_encoder.h"

namespace ifa {

namespace {

constexpr int kNeutral = 1 << 16;  // contrast and saturation of swscale that change nothing

LibavPtr<AVFrame> makePicture(AVPixelFormat format, int width, int height) {
  LibavPtr<AVFrame> frame(av_frame_alloc());
  if (!frame) return nullptr;
  frame->format = format;
  frame->width = width;
  frame->height = height;
  return av_frame_get_buffer(frame.get(), 0) < 0 ? nullptr : std::move(frame);
}

// A copy, because swscale reads beyond the end of rows.
void copyRows(const Image& image, AVFrame& frame) {
  const std::size_t bytes = static_cast<std::size_t>(image.width) * 3;
  for (int row = 0; row < image.height; ++row) {
    std::memcpy(frame.data[0] + static_cast<std::ptrdiff_t>(row) * frame.linesize[0],
                image.rgb.data() + static_cast<std::size_t>(row) * bytes, bytes);
  }
}

bool fits(const Image& image, const AVFrame& frame) {
  return image.width == frame.width && image.height == frame.height &&
         image.rgb.size() ==
             static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
}

}  // namespace

Result<void> VideoStream::makeConverter() {
  const int width = encoder_->width, height = encoder_->height;
  rgb_ = makePicture(AV_PIX_FMT_RGB24, width, height);
  yuv_ = makePicture(AV_PIX_FMT_YUV420P, width, height);
  SwsContext* sws = sws_alloc_context();
  converter_.reset(sws);
  if (!rgb_ || !yuv_ || sws == nullptr) return libavError("no pictures", AVERROR(ENOMEM));
  for (const char* side : {"src", "dst"}) {
    const bool source = side[0] == 's';
    av_opt_set_int(sws, (side + std::string("w")).c_str(), width, 0);
    av_opt_set_int(sws, (side + std::string("h")).c_str(), height, 0);
    av_opt_set_int(sws, (side + std::string("_format")).c_str(),
                   source ? AV_PIX_FMT_RGB24 : AV_PIX_FMT_YUV420P, 0);
  }
  // Chroma beside the left of two pixels and between two rows, as AVCHROMA_LOC_LEFT says; in
  // 1/256 pixel.
  av_opt_set_int(sws, "dst_h_chr_pos", 0, 0);
  av_opt_set_int(sws, "dst_v_chr_pos", 128, 0);
  av_opt_set_int(sws, "sws_flags",
                 SWS_BILINEAR | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT, 0);
  const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
  sws_setColorspaceDetails(sws, bt709, 1, bt709, 0, 0, kNeutral, kNeutral);
  const int code = sws_init_context(sws, nullptr, nullptr);
  if (code < 0) return libavError("colours cannot be converted", code);
  return {};
}

Result<VideoStream> VideoStream::open(const FilmSettings& settings, FrameRate rate, Muxer& muxer) {
  VideoStream stream;
  auto encoder = openVideoEncoder(settings, rate);
  if (!encoder) return tl::unexpected(encoder.error());
  stream.encoder_ = std::move(*encoder);
  stream.warning_ = encoderWarning(*stream.encoder_);
  const auto track = muxer.addTrack(*stream.encoder_, {rate.seconds, rate.frames});
  if (!track) return tl::unexpected(track.error());
  stream.track_ = *track;
  if (auto good = stream.makeConverter(); !good) return tl::unexpected(good.error());
  return stream;
}

Result<void> VideoStream::add(const Image& frame, Muxer& muxer) {
  if (!fits(frame, *rgb_)) {
    return tl::unexpected<Error>(Error{
        ErrorCode::kInternal,
        "a frame of " + std::to_string(frame.width) + "x" + std::to_string(frame.height) +
            " in a film of " + std::to_string(rgb_->width) + "x" + std::to_string(rgb_->height),
        "frame " + std::to_string(frames_),
        {}});
  }
  copyRows(frame, *rgb_);
  // The encoder may still hold the last one.
  const int writable = av_frame_make_writable(yuv_.get());
  if (writable < 0) return libavError("no picture", writable);
  const int rows = sws_scale(converter_.get(), rgb_->data, rgb_->linesize, 0, rgb_->height,
                             yuv_->data, yuv_->linesize);
  if (rows < 0) return libavError("colours cannot be converted", rows);
  yuv_->pts = frames_++;
  return muxer.encode(*encoder_, yuv_.get(), track_);
}

Result<void> VideoStream::finish(Muxer& muxer) { return muxer.encode(*encoder_, nullptr, track_); }

}  // namespace ifa
#endif
