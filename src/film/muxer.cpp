// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/muxer.h"

#include <cerrno>

namespace ifa {

namespace {

constexpr int kBufferBytes = 1 << 18;

// libav's own file access loses what closing reports, so the file is ours.
int writeBytes(void* file, std::uint8_t* bytes, int count) {
  const bool good = static_cast<TemporaryFile*>(file)->write(bytes, static_cast<size_t>(count));
  return good ? count : AVERROR(EIO);
}

std::int64_t seekBytes(void* file, std::int64_t offset, int whence) {
  auto& it = *static_cast<TemporaryFile*>(file);
  if ((whence & AVSEEK_SIZE) != 0) return it.size();
  return it.seek(offset, whence & ~AVSEEK_FORCE);
}

LibavPtr<AVIOContext> openIo(TemporaryFile& file) {
  auto* buffer = static_cast<unsigned char*>(av_malloc(kBufferBytes));
  if (buffer == nullptr) return nullptr;
  LibavPtr<AVIOContext> io(
      avio_alloc_context(buffer, kBufferBytes, 1, &file, nullptr, writeBytes, seekBytes));
  if (!io) av_free(buffer);
  return io;
}

}  // namespace

tl::unexpected<Error> Muxer::failure(const char* what, int code) const {
  if (file_.failed()) return file_.error();
  return libavError(what, code);
}

Result<std::unique_ptr<Muxer>> Muxer::open(const std::filesystem::path& path) {
  std::unique_ptr<Muxer> muxer(new Muxer);
  if (auto good = muxer->file_.create(path); !good) return tl::unexpected(good.error());
  AVFormatContext* format = nullptr;
  // To put the table of contents in front, libav reads the file once more by its name.
  const std::string url = "file:" + muxer->file_.temporaryName();
  const int code = avformat_alloc_output_context2(&format, nullptr, "mp4", url.c_str());
  muxer->format_.reset(format);
  muxer->io_ = openIo(muxer->file_);
  muxer->packet_.reset(av_packet_alloc());
  if (code < 0 || !muxer->io_ || !muxer->packet_) {
    return libavError("an MP4 file cannot be begun", code < 0 ? code : AVERROR(ENOMEM));
  }
  format->pb = muxer->io_.get();
  format->flags |= AVFMT_FLAG_BITEXACT;  // neither the hour nor libav's version
  return muxer;
}

Result<int> Muxer::addTrack(const AVCodecContext& encoder, AVRational timeBase) {
  AVStream* stream = avformat_new_stream(format_.get(), nullptr);
  if (stream == nullptr) return libavError("a track cannot be added", AVERROR(ENOMEM));
  const int code = avcodec_parameters_from_context(stream->codecpar, &encoder);
  if (code < 0) return libavError("a track cannot be added", code);
  stream->time_base = timeBase;
  if (encoder.codec_type == AVMEDIA_TYPE_VIDEO) {
    stream->avg_frame_rate = stream->r_frame_rate = av_inv_q(timeBase);
  }
  timeBases_.push_back(timeBase);
  return stream->index;
}

Result<void> Muxer::start(int timescale) {
  AVDictionary* options = nullptr;
  av_dict_set(&options, "movflags", "+faststart+write_colr", 0);
  av_dict_set_int(&options, "movie_timescale", timescale, 0);
  av_dict_set_int(&options, "video_track_timescale", timescale, 0);
  const int code = avformat_write_header(format_.get(), &options);
  av_dict_free(&options);
  if (code < 0 || file_.failed()) return failure("the film's head cannot be written", code);
  return {};
}

Result<void> Muxer::writePacket(const AVCodecContext& encoder, int track) {
  AVPacket& packet = *packet_;
  // The unit of a video's time is a frame; from time stamps alone the last would have no length.
  if (encoder.codec_type == AVMEDIA_TYPE_VIDEO) packet.duration = 1;
  packet.stream_index = track;
  const auto index = static_cast<unsigned>(track);
  av_packet_rescale_ts(&packet, timeBases_[index], format_->streams[index]->time_base);
  const int code = av_interleaved_write_frame(format_.get(), &packet);
  if (code < 0 || file_.failed()) return failure("the film cannot be written", code);
  return {};
}

Result<void> Muxer::encode(AVCodecContext& encoder, const AVFrame* frame, int track) {
  const int sent = avcodec_send_frame(&encoder, frame);
  if (sent < 0) return failure("a frame cannot be encoded", sent);
  while (true) {
    const int code = avcodec_receive_packet(&encoder, packet_.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
    if (code < 0) return failure("a frame cannot be encoded", code);
    if (auto good = writePacket(encoder, track); !good) return good;
  }
}

Result<void> Muxer::finish() {
  const int code = av_write_trailer(format_.get());
  avio_flush(io_.get());
  if (code < 0 || io_->error < 0 || file_.failed()) {
    return failure("the film cannot be completed", code < 0 ? code : io_->error);
  }
  return file_.commit();
}

}  // namespace ifa
#endif
