// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/film_writer.h"

#include <optional>
#include <utility>

#include "film/audio_stream.h"
#include "film/film_settings.h"
#include "film/libav.h"
#include "film/muxer.h"
#include "film/video_stream.h"

namespace ifa {

namespace {

constexpr int kMinTimescale = 10000;  // units a second; what libav's MP4 writer wants

// A multiple of the frame rate's numerator, so that every frame and the film's length are whole.
int timescaleOf(FrameRate rate) {
  int timescale = rate.frames;
  while (timescale < kMinTimescale) timescale *= 2;
  return timescale;
}

Error closedError(const char* why) {
  return {ErrorCode::kInternal, why, "film", "open another writer"};
}

}  // namespace

struct FilmWriter::Encoder {
  FrameRate rate;
  std::unique_ptr<Muxer> muxer;
  VideoStream video;
  std::optional<AudioStream> audio;
  std::optional<Error> closed;  // why no more frames are taken

  Result<void> add(const Image& frame) {
    if (auto good = video.add(frame, *muxer); !good || !audio) return good;
    const auto heard = samplesOfFrames(video.frames(), rate, AudioStream::kRate);
    return audio->encodeUntil(heard, *muxer);
  }

  Result<void> finish() {
    if (video.frames() == 0) return tl::unexpected(closedError("a film needs a frame"));
    if (auto good = video.finish(*muxer); !good) return good;
    if (audio) {
      const auto heard = samplesOfFrames(video.frames(), rate, AudioStream::kRate);
      if (auto good = audio->finish(heard, *muxer); !good) return good;
    }
    return muxer->finish();
  }

  // After a failure the file is worth nothing, and every later call fails as the first did.
  Result<void> guard(Result<void> result) {
    if (!result) {
      muxer->discard();
      closed = result.error();
    }
    return result;
  }
};

bool filmsCanBeWritten() { return true; }

Result<FilmWriter> FilmWriter::open(const std::filesystem::path& path, const FilmSettings& settings,
                                    const Sound* sound) {
  if (auto good = checkFilmSettings(settings, sound); !good) return tl::unexpected(good.error());
  keepLibavQuiet();
  const FrameRate rate = exactFrameRate(settings.framesPerSecond);
  auto muxer = Muxer::open(path);
  if (!muxer) return tl::unexpected(muxer.error());
  auto video = VideoStream::open(settings, rate, **muxer);
  if (!video) return tl::unexpected(video.error());
  std::optional<AudioStream> audio;
  if (sound != nullptr) {
    auto opened = AudioStream::open(*sound, settings.speed, **muxer);
    if (!opened) return tl::unexpected(opened.error());
    audio.emplace(std::move(*opened));
  }
  if (auto good = (*muxer)->start(timescaleOf(rate)); !good) return tl::unexpected(good.error());
  return FilmWriter(std::make_unique<Encoder>(
      Encoder{rate, std::move(*muxer), std::move(*video), std::move(audio), {}}));
}

FilmWriter::FilmWriter(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter::~FilmWriter() = default;

Result<void> FilmWriter::add(const Image& frame) {
  if (encoder_->closed) return tl::unexpected(*encoder_->closed);
  return encoder_->guard(encoder_->add(frame));
}

Result<void> FilmWriter::finish() {
  if (encoder_->closed) return tl::unexpected(*encoder_->closed);
  auto result = encoder_->guard(encoder_->finish());
  if (result) encoder_->closed = closedError("the film is finished");
  return result;
}

const std::string& FilmWriter::warning() const { return encoder_->video.warning(); }

}  // namespace ifa
#endif
