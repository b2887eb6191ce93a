// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/audio_stream.h"

#include <cerrno>

namespace ifa {

namespace {

constexpr std::int64_t kFirstChannelBits = 128000;  // a second; clicks need more than music
constexpr std::int64_t kOtherChannelBits = 96000;

Result<LibavPtr<AVCodecContext>> openEncoder(int channels) {
  const AVCodec* codec = avcodec_find_encoder_by_name("aac");  // libav's own
  LibavPtr<AVCodecContext> encoder(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
  if (!encoder) return libavError("there is no AAC encoder", AVERROR_ENCODER_NOT_FOUND);
  encoder->sample_fmt = AV_SAMPLE_FMT_FLTP;
  encoder->sample_rate = AudioStream::kRate;
  encoder->time_base = {1, AudioStream::kRate};
  encoder->bit_rate = kFirstChannelBits + (channels - 1) * kOtherChannelBits;
  encoder->thread_count = 1;
  encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_BITEXACT;
  av_channel_layout_default(&encoder->ch_layout, channels);
  const int code = avcodec_open2(encoder.get(), codec, nullptr);
  if (code < 0) return libavError("the AAC encoder does not open", code);
  return encoder;
}

}  // namespace

Result<AudioStream> AudioStream::open(const Sound& sound, double speed, Muxer& muxer) {
  auto source = StretchedSound::open(sound, speed, kRate);
  if (!source) return tl::unexpected(source.error());
  auto encoder = openEncoder(source->channels());
  if (!encoder) return tl::unexpected(encoder.error());
  AudioStream stream(std::move(*source));
  stream.encoder_ = std::move(*encoder);
  const auto track = muxer.addTrack(*stream.encoder_, stream.encoder_->time_base);
  if (!track) return tl::unexpected(track.error());
  stream.track_ = *track;
  return stream;
}

Result<void> AudioStream::encodeBlock(int count, Muxer& muxer) {
  LibavPtr<AVFrame> frame(av_frame_alloc());
  if (!frame) return libavError("no room for sound", AVERROR(ENOMEM));
  frame->format = AV_SAMPLE_FMT_FLTP;
  frame->sample_rate = kRate;
  frame->nb_samples = count;
  frame->pts = next_;
  av_channel_layout_copy(&frame->ch_layout, &encoder_->ch_layout);
  const int code = av_frame_get_buffer(frame.get(), 0);
  if (code < 0) return libavError("no room for sound", code);
  auto* const* planes = reinterpret_cast<float* const*>(frame->data);
  if (auto good = source_.read(planes, static_cast<std::size_t>(count)); !good) return good;
  next_ += count;
  return muxer.encode(*encoder_, frame.get(), track_);
}

Result<void> AudioStream::encodeUntil(std::int64_t end, Muxer& muxer) {
  while (next_ + encoder_->frame_size <= end) {
    if (auto good = encodeBlock(encoder_->frame_size, muxer); !good) return good;
  }
  return {};
}

Result<void> AudioStream::finish(std::int64_t end, Muxer& muxer) {
  if (auto good = encodeUntil(end, muxer); !good) return good;
  if (next_ < end) {
    if (auto good = encodeBlock(static_cast<int>(end - next_), muxer); !good) return good;
  }
  return muxer.encode(*encoder_, nullptr, track_);
}

}  // namespace ifa
#endif
