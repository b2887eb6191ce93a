// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/video_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ifa {

namespace {

constexpr const char* kRemedy = "install an FFmpeg (libavcodec) with libx264";
constexpr int kMaxMpeg4Ticks = 65535;     // a second, by the standard
constexpr double kBitsPerPixel = 0.15;    // of encoders that want a bit rate, at quality 20
constexpr double kKeyFrameSeconds = 1.0;  // players and editors jump to key frames

bool takesOurPictures(const AVCodec& codec) {
  const AVPixelFormat* format = codec.pix_fmts;
  while (format != nullptr && *format != AV_PIX_FMT_NONE && *format != AV_PIX_FMT_YUV420P) {
    ++format;
  }
  return format != nullptr && *format == AV_PIX_FMT_YUV420P;
}

bool fitsIntoMp4(const AVCodec& codec) {
  const AVOutputFormat* mp4 = av_guess_format("mp4", nullptr, nullptr);
  return mp4 != nullptr && avformat_query_codec(mp4, codec.id, FF_COMPLIANCE_NORMAL) == 1;
}

void setPicture(AVCodecContext& encoder, const FilmSettings& settings, FrameRate rate) {
  encoder.width = settings.width;
  encoder.height = settings.height;
  encoder.pix_fmt = AV_PIX_FMT_YUV420P;
  encoder.sample_aspect_ratio = {1, 1};
  encoder.framerate = {rate.frames, rate.seconds};
  encoder.time_base = av_inv_q(encoder.framerate);
  encoder.color_primaries = AVCOL_PRI_BT709;
  encoder.color_trc = AVCOL_TRC_BT709;
  encoder.colorspace = AVCOL_SPC_BT709;
  encoder.color_range = AVCOL_RANGE_MPEG;
  encoder.chroma_sample_location = AVCHROMA_LOC_LEFT;
  encoder.gop_size = static_cast<int>(std::lround(kKeyFrameSeconds * settings.framesPerSecond));
  // Frames in the order in which they are seen: no player has to know that the first comes late.
  encoder.max_b_frames = 0;
  encoder.thread_count = 1;
  encoder.flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
}

void setX264Quality(AVCodecContext& encoder, double quality) {
  av_opt_set(encoder.priv_data, "preset", "veryfast", 0);
  av_opt_set(encoder.priv_data, "x264-params", "cpu-independent=1", 0);
  av_opt_set_double(encoder.priv_data, "crf", quality, 0);
}

// The scale of H.264 doubles its step every 6; the older codecs' is proportional to the step.
void setMpeg4Quality(AVCodecContext& encoder, double quality) {
  const double scale = std::clamp(std::exp2((quality - 4) / 6) / 2, 1.0, 31.0);
  encoder.flags |= AV_CODEC_FLAG_QSCALE;
  encoder.global_quality = static_cast<int>(std::lround(scale * FF_QP2LAMBDA));
  // Only inside the pictures' headers: the file has the exact rate.
  av_reduce(&encoder.time_base.num, &encoder.time_base.den, encoder.time_base.num,
            encoder.time_base.den, kMaxMpeg4Ticks);
}

void setBitRate(AVCodecContext& encoder, const FilmSettings& settings) {
  const double pixels = settings.framesPerSecond * settings.width * settings.height;
  encoder.bit_rate = std::llround(pixels * kBitsPerPixel * std::exp2((20 - settings.quality) / 6));
}

LibavPtr<AVCodecContext> open(const AVCodec& codec, const FilmSettings& settings, FrameRate rate) {
  LibavPtr<AVCodecContext> encoder(avcodec_alloc_context3(&codec));
  if (!encoder) return nullptr;
  setPicture(*encoder, settings, rate);
  if (std::strncmp(codec.name, "libx264", 7) == 0) {
    setX264Quality(*encoder, settings.quality);
  } else if (codec.id == AV_CODEC_ID_MPEG4) {
    setMpeg4Quality(*encoder, settings.quality);
  } else {
    setBitRate(*encoder, settings);
  }
  return avcodec_open2(encoder.get(), &codec, nullptr) < 0 ? nullptr : std::move(encoder);
}

}  // namespace

Result<LibavPtr<AVCodecContext>> openVideoEncoder(const FilmSettings& settings, FrameRate rate) {
  std::string tried;
  for (const std::string& name : settings.encoders) {
    tried += (tried.empty() ? "" : ", ") + name;
    const AVCodec* codec = avcodec_find_encoder_by_name(name.c_str());
    if (codec == nullptr || !takesOurPictures(*codec) || !fitsIntoMp4(*codec)) continue;
    // One for hardware that is not there is found, but does not open.
    if (auto encoder = open(*codec, settings, rate)) return encoder;
  }
  return tl::unexpected<Error>(Error{
      ErrorCode::kInternal, "no video encoder can be used, tried: " + tried, "encoders", kRemedy});
}

std::string encoderWarning(const AVCodecContext& encoder) {
  if (encoder.codec_id == AV_CODEC_ID_H264) return {};
  return std::string("the film is not H.264 but ") + avcodec_get_name(encoder.codec_id) +
         " (encoder " + encoder.codec->name +
         "), which browsers and some editors do not play: " + kRemedy;
}

}  // namespace ifa
#endif
