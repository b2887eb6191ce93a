// SPDX-License-Identifier: Apache-2.0
#include "read_film.h"

#include <map>
#include <memory>
#include <stdexcept>

#include "film/libav.h"
#include "support/temporary_folder.h"

namespace ifa::test {

namespace {

struct CloseInput {
  void operator()(AVFormatContext* it) const { avformat_close_input(&it); }
};
using Input = std::unique_ptr<AVFormatContext, CloseInput>;
using Decoder = LibavPtr<AVCodecContext>;

void require(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

Fraction timeOf(std::int64_t ticks, AVRational base) { return {ticks * base.num, base.den}; }

std::vector<std::uint8_t> planeOf(const AVFrame& frame, int plane, int width, int height) {
  std::vector<std::uint8_t> bytes;
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* first = frame.data[plane] + row * frame.linesize[plane];
    bytes.insert(bytes.end(), first, first + width);
  }
  return bytes;
}

void keepPicture(const AVFrame& frame, const AVStream& stream, DecodedFilm& film) {
  require(frame.format == AV_PIX_FMT_YUV420P, "not 4:2:0");
  film.frames.push_back({timeOf(frame.pts, stream.time_base), frame.key_frame != 0, frame.width,
                         planeOf(frame, 0, frame.width, frame.height),
                         planeOf(frame, 1, frame.width / 2, frame.height / 2),
                         planeOf(frame, 2, frame.width / 2, frame.height / 2)});
}

void keepSound(const AVFrame& frame, const AVStream& stream, DecodedFilm& film) {
  require(frame.format == AV_SAMPLE_FMT_FLTP, "not floats");
  require(stream.time_base.den == film.soundRate, "sound is not timed in samples");
  if (film.sound.empty()) {
    film.sound.resize(static_cast<std::size_t>(frame.ch_layout.nb_channels));
    film.firstSample = frame.pts;
  }
  const auto end = film.firstSample + static_cast<std::int64_t>(film.sound[0].size());
  require(frame.pts == end, "sound has a gap");
  for (std::size_t c = 0; c < film.sound.size(); ++c) {
    const auto* first = reinterpret_cast<const float*>(frame.extended_data[c]);
    film.sound[c].insert(film.sound[c].end(), first, first + frame.nb_samples);
  }
}

void decode(AVCodecContext& decoder, const AVPacket* packet, const AVStream& stream,
            DecodedFilm& film) {
  require(avcodec_send_packet(&decoder, packet) >= 0, "a packet cannot be decoded");
  const LibavPtr<AVFrame> frame(av_frame_alloc());
  while (avcodec_receive_frame(&decoder, frame.get()) >= 0) {
    const bool picture = decoder.codec_type == AVMEDIA_TYPE_VIDEO;
    (picture ? keepPicture : keepSound)(*frame, stream, film);
  }
}

void describe(const AVStream& stream, DecodedFilm& film) {
  const AVCodecParameters& codec = *stream.codecpar;
  if (codec.codec_type == AVMEDIA_TYPE_VIDEO) {
    film.videoCodec = avcodec_get_name(codec.codec_id);
    film.width = codec.width;
    film.height = codec.height;
    film.frameRate = {stream.avg_frame_rate.num, stream.avg_frame_rate.den};
    film.videoDuration = timeOf(stream.duration, stream.time_base);
    film.colourTags = {codec.color_primaries, codec.color_trc, codec.color_space,
                       codec.color_range};
  } else {
    film.soundCodec = avcodec_get_name(codec.codec_id);
    film.soundRate = codec.sample_rate;
    film.soundDuration = timeOf(stream.duration, stream.time_base);
  }
}

Decoder openDecoder(const AVStream& stream) {
  const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
  Decoder decoder(avcodec_alloc_context3(codec));
  require(avcodec_parameters_to_context(decoder.get(), stream.codecpar) >= 0, "no parameters");
  decoder->pkt_timebase = stream.time_base;
  decoder->thread_count = 1;
  require(avcodec_open2(decoder.get(), codec, nullptr) >= 0, "no decoder");
  return decoder;
}

}  // namespace

std::array<double, 3> DecodedFrame::rgbAt(int column, int row) const {
  const auto luma = static_cast<std::size_t>(row * width + column);
  const auto chroma = static_cast<std::size_t>((row / 2) * (width / 2) + column / 2);
  const double brightness = (y[luma] - 16) / 219.0;
  const double blue = brightness + 1.8556 * (u[chroma] - 128) / 224.0;
  const double red = brightness + 1.5748 * (v[chroma] - 128) / 224.0;
  const double green = (brightness - 0.2126 * red - 0.0722 * blue) / 0.7152;
  return {255 * red, 255 * green, 255 * blue};
}

DecodedFilm readFilm(const std::filesystem::path& path) {
  keepLibavQuiet();
  AVFormatContext* opened = nullptr;
  require(avformat_open_input(&opened, path.c_str(), nullptr, nullptr) >= 0, "no film");
  const Input input(opened);
  require(avformat_find_stream_info(opened, nullptr) >= 0, "no tracks");
  DecodedFilm film;
  film.duration = static_cast<double>(opened->duration) / AV_TIME_BASE;
  std::map<int, Decoder> decoders;
  for (unsigned i = 0; i < opened->nb_streams; ++i) {
    describe(*opened->streams[i], film);
    decoders[static_cast<int>(i)] = openDecoder(*opened->streams[i]);
  }
  const LibavPtr<AVPacket> packet(av_packet_alloc());
  while (av_read_frame(opened, packet.get()) >= 0) {
    const int track = packet->stream_index;
    decode(*decoders[track], packet.get(), *opened->streams[track], film);
    av_packet_unref(packet.get());
  }
  for (auto& [track, decoder] : decoders) {
    decode(*decoder, nullptr, *opened->streams[track], film);
  }
  return film;
}

std::vector<std::string> boxesOf(const std::filesystem::path& path) {
  const std::string bytes = readText(path);
  std::vector<std::string> names;
  for (std::size_t at = 0; at + 8 <= bytes.size();) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i)
      size = size << 8 | static_cast<unsigned char>(bytes[at + i]);
    require(size >= 8, "a box without size");
    names.push_back(bytes.substr(at + 4, 4));
    at += size;
  }
  return names;
}

}  // namespace ifa::test
