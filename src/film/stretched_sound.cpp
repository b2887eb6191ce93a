// SPDX-License-Identifier: Apache-2.0
#ifdef IFA_WITH_FILM
#include "film/stretched_sound.h"

#include <algorithm>
#include <cerrno>

namespace ifa {

namespace {

constexpr int kChunk = 8192;  // samples of a channel that are converted at once
// swresample needs the terms of the ratio to be this small; its error is below 1e-8, since one of
// them is large where the ratio is not exact.
constexpr int kMaxTerm = 1 << 20;

LibavPtr<SwrContext> makeResampler(int channels, AVRational ratio) {
  AVChannelLayout layout{};
  av_channel_layout_default(&layout, channels);
  SwrContext* swr = nullptr;
  // Only the ratio of the two rates counts.
  swr_alloc_set_opts2(&swr, &layout, AV_SAMPLE_FMT_FLTP, ratio.den, &layout, AV_SAMPLE_FMT_FLT,
                      ratio.num, 0, nullptr);
  LibavPtr<SwrContext> resampler(swr);
  if (swr == nullptr) return nullptr;
  av_opt_set_int(swr, "linear_interp", 1, 0);  // between the filter's 1024 phases
  return swr_init(swr) < 0 ? nullptr : std::move(resampler);
}

}  // namespace

Result<StretchedSound> StretchedSound::open(const Sound& sound, double speed, int rate) {
  StretchedSound stretched;
  const bool stereo = sound.channels == 2 && sound.interleaved.size() == 2 * sound.samples.size();
  stretched.channels_ = stereo ? 2 : 1;
  stretched.source_ = stereo ? &sound.interleaved : &sound.samples;
  stretched.pending_.resize(static_cast<std::size_t>(stretched.channels_));
  const AVRational ratio = av_d2q(sound.rate * speed / rate, kMaxTerm);
  stretched.resampler_ = makeResampler(stretched.channels_, ratio);
  if (!stretched.resampler_) return libavError("the sound cannot be resampled", AVERROR(EINVAL));
  return stretched;
}

Result<void> StretchedSound::convertMore() {
  const auto channels = static_cast<std::size_t>(channels_);
  // Silence follows the sound: flushing swresample would mirror the sound's end.
  std::vector<float> chunk(kChunk * channels);
  const std::size_t count = std::min(chunk.size(), source_->size() - next_);
  std::copy_n(source_->begin() + static_cast<std::ptrdiff_t>(next_), count, chunk.begin());
  next_ += count;

  const int room = swr_get_out_samples(resampler_.get(), kChunk);
  if (room < 0) return libavError("the sound cannot be resampled", room);
  const std::size_t before = pending_[0].size();
  std::uint8_t* out[2] = {};
  for (std::size_t c = 0; c < channels; ++c) {
    pending_[c].resize(before + static_cast<std::size_t>(room));
    out[c] = reinterpret_cast<std::uint8_t*>(pending_[c].data() + before);
  }
  const auto* in = reinterpret_cast<const std::uint8_t*>(chunk.data());
  const int made = swr_convert(resampler_.get(), out, room, &in, kChunk);
  if (made < 0) return libavError("the sound cannot be resampled", made);
  for (auto& channel : pending_) channel.resize(before + static_cast<std::size_t>(made));
  return {};
}

Result<void> StretchedSound::read(float* const* planes, std::size_t count) {
  while (pending_[0].size() < count) {
    if (auto good = convertMore(); !good) return good;
  }
  for (std::size_t c = 0; c < pending_.size(); ++c) {
    const auto end = pending_[c].begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(pending_[c].begin(), end, planes[c]);
    pending_[c].erase(pending_[c].begin(), end);
  }
  return {};
}

}  // namespace ifa
#endif
