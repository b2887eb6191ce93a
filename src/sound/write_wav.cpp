// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "base/file.h"
#include "sound/sound.h"

namespace ifa {
namespace {

/// A file in memory, as libsndfile's virtual input and output wants it.
struct MemoryFile {
  std::string bytes;
  std::size_t position = 0;

  static MemoryFile& of(void* self) { return *static_cast<MemoryFile*>(self); }
  static sf_count_t length(void* self) { return static_cast<sf_count_t>(of(self).bytes.size()); }
  static sf_count_t tell(void* self) { return static_cast<sf_count_t>(of(self).position); }
  static sf_count_t seek(sf_count_t offset, int whence, void* self) {
    const sf_count_t base =
        whence == SEEK_SET ? 0 : (whence == SEEK_CUR ? tell(self) : length(self));
    of(self).position = static_cast<std::size_t>(std::max<sf_count_t>(0, base + offset));
    return tell(self);
  }
  static sf_count_t read(void* to, sf_count_t count, void* self) {
    MemoryFile& file = of(self);
    const std::size_t left =
        file.bytes.size() - std::min<std::size_t>(file.position, file.bytes.size());
    const std::size_t taken = std::min(left, static_cast<std::size_t>(count));
    std::memcpy(to, file.bytes.data() + file.position, taken);
    file.position += taken;
    return static_cast<sf_count_t>(taken);
  }
  static sf_count_t write(const void* from, sf_count_t count, void* self) {
    MemoryFile& file = of(self);
    const std::size_t end = file.position + static_cast<std::size_t>(count);
    if (end > file.bytes.size()) file.bytes.resize(end);
    std::memcpy(file.bytes.data() + file.position, from, static_cast<std::size_t>(count));
    file.position = end;
    return count;
  }
};

int sndfileFormat(const Sound& sound) {
  const int container = sound.channels > 2 ? SF_FORMAT_WAVEX : SF_FORMAT_WAV;
  switch (sound.format) {
    case SampleFormat::kPcm24:
      return container | SF_FORMAT_PCM_24;
    case SampleFormat::kFloat:
      return container | SF_FORMAT_FLOAT;
    default:
      return container | SF_FORMAT_PCM_16;
  }
}

int bytesPerSample(SampleFormat format) {
  return format == SampleFormat::kPcm16 ? 2 : format == SampleFormat::kPcm24 ? 3 : 4;
}

/// Integers of `bits` bits at the top of an int, saturated. libsndfile reads n / 2^15 but writes
/// x (2^15 - 1), which would change every other sample.
std::vector<int> quantised(const std::vector<float>& values, int bits) {
  const double scale = std::ldexp(1.0, bits - 1);
  std::vector<int> integers(values.size());
  std::transform(values.begin(), values.end(), integers.begin(), [&](float value) {
    const double rounded = std::nearbyint(static_cast<double>(value) * scale);
    return static_cast<int>(std::clamp(rounded, -scale, scale - 1)) * (1 << (32 - bits));
  });
  return integers;
}

bool writeSamples(SNDFILE* file, const std::vector<float>& values, SampleFormat format) {
  const auto count = static_cast<sf_count_t>(values.size());
  if (format == SampleFormat::kFloat) return sf_write_float(file, values.data(), count) == count;
  const auto integers = quantised(values, 8 * bytesPerSample(format));
  return sf_write_int(file, integers.data(), count) == count;
}

bool writeAll(SNDFILE* file, const Sound& sound, std::size_t silentFrames) {
  const auto& values = sound.interleaved.empty() ? sound.samples : sound.interleaved;
  const std::vector<float> silence(silentFrames * static_cast<std::size_t>(sound.channels), 0.0F);
  return writeSamples(file, silence, sound.format) && writeSamples(file, values, sound.format);
}

}  // namespace

Result<void> writeWav(const std::filesystem::path& path, const Sound& sound,
                      double leadingSilence) {
  const double silentFrames = std::nearbyint(std::max(0.0, leadingSilence) * sound.rate);
  const double bytes = (silentFrames + static_cast<double>(sound.samples.size())) * sound.channels *
                       bytesPerSample(sound.format);
  if (!(bytes < 4294960000.0)) {
    return badInput("the sound does not fit into a WAV file (4 GiB)", path.string(),
                    "cut out the part with the contacts");
  }
  SF_INFO info{};
  info.samplerate = sound.rate;
  info.channels = sound.channels;
  info.format = sndfileFormat(sound);
  SF_VIRTUAL_IO access{&MemoryFile::length, &MemoryFile::seek, &MemoryFile::read,
                       &MemoryFile::write, &MemoryFile::tell};
  MemoryFile memory;
  SNDFILE* file = sf_open_virtual(&access, SFM_WRITE, &info, &memory);
  if (file == nullptr) {
    return badInput(fmt::format("cannot be written: {}", sf_strerror(nullptr)), path.string());
  }
  // Without this a float file carries the time of writing (its PEAK chunk), and differs every time.
  sf_command(file, SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
  const bool good = writeAll(file, sound, static_cast<std::size_t>(silentFrames));
  if (sf_close(file) != SF_ERR_NO_ERROR || !good) {
    return badInput("cannot be written: not all samples were taken", path.string());
  }
  return writeFileAtomically(path, memory.bytes);
}

}  // namespace ifa
