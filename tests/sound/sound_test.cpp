// SPDX-License-Identifier: Apache-2.0
#include "sound/sound.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace ifa {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

/// Writes interleaved samples with libsndfile itself, so that reading is not tested against
/// writing.
void writeFile(const std::filesystem::path& path, int format, int rate, int channels,
               const std::vector<float>& values) {
  SF_INFO info{};
  info.samplerate = rate;
  info.channels = channels;
  info.format = format;
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  ASSERT_NE(file, nullptr) << sf_strerror(nullptr);
  sf_command(file, SFC_SET_CLIPPING, nullptr, SF_TRUE);
  ASSERT_EQ(sf_write_float(file, values.data(), static_cast<sf_count_t>(values.size())),
            static_cast<sf_count_t>(values.size()));
  sf_close(file);
}

/// A tone of 500 Hz in every channel, the first louder than the next ones.
std::vector<float> tone(int rate, int channels, double seconds) {
  std::vector<float> values;
  for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
    for (int c = 0; c < channels; ++c) {
      values.push_back(static_cast<float>(0.5 / (c + 1) * std::sin(2 * M_PI * 500 * i / rate)));
    }
  }
  return values;
}

double peakOf(const Sound& sound) {
  double peak = 0;
  for (const float sample : sound.samples) {
    peak = std::max(peak, static_cast<double>(std::abs(sample)));
  }
  return peak;
}

struct FormatCase {
  std::string name;
  int format, rate, channels;
  SampleFormat kept;
};

class ReadsEveryFormat : public testing::TestWithParam<FormatCase> {};

TEST_P(ReadsEveryFormat, LengthRateAndLevel) {
  const FormatCase& given = GetParam();
  const TemporaryFolder folder;
  const auto path = folder / ("tone." + given.name);
  writeFile(path, given.format, given.rate, given.channels, tone(given.rate, given.channels, 0.5));
  const auto sound = readSound(path);
  ASSERT_TRUE(sound) << sound.error().text();
  EXPECT_EQ(sound->rate, given.rate);
  EXPECT_EQ(sound->channels, given.channels);
  EXPECT_EQ(sound->format, given.kept);
  // MP3 pads to whole frames.
  EXPECT_NEAR(sound->duration(), 0.5, given.name == "mp3" ? 0.06 : 1e-4);
  double mean = 0;
  for (int c = 0; c < given.channels; ++c) mean += 0.5 / (c + 1) / given.channels;
  EXPECT_NEAR(peakOf(*sound), mean, 0.05 * mean);
  EXPECT_EQ(
      sound->interleaved.size(),
      given.channels == 1 ? 0 : sound->samples.size() * static_cast<std::size_t>(given.channels));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, ReadsEveryFormat,
    testing::Values(
        FormatCase{"wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1, SampleFormat::kPcm16},
        FormatCase{"8.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_U8, 8000, 1, SampleFormat::kPcm16},
        FormatCase{"24.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_24, 96000, 2, SampleFormat::kPcm24},
        FormatCase{"float.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 192000, 2, SampleFormat::kFloat},
        FormatCase{"6.wav", SF_FORMAT_WAVEX | SF_FORMAT_PCM_16, 48000, 6, SampleFormat::kPcm16},
        FormatCase{"flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_24, 88200, 2, SampleFormat::kPcm24},
        FormatCase{"ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS, 44100, 2, SampleFormat::kPcm16},
        FormatCase{"opus", SF_FORMAT_OGG | SF_FORMAT_OPUS, 48000, 1, SampleFormat::kPcm16},
        FormatCase{"mp3", SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III, 44100, 2,
                   SampleFormat::kPcm16}));

TEST(ReadSound, ChannelsOfOppositeSignDoNotCancel) {
  const TemporaryFolder folder;
  auto values = tone(44100, 2, 0.1);
  for (std::size_t i = 0; i < values.size(); i += 2) values[i + 1] = -values[i];
  writeFile(folder / "a.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 44100, 2, values);
  const auto sound = readSound(folder / "a.wav");
  ASSERT_TRUE(sound);
  EXPECT_NEAR(peakOf(*sound), 0.5, 0.01);
}

/// What reading a file complains of; empty when it does not.
std::string complaint(const std::filesystem::path& path, const SoundLimits& limits = {}) {
  const auto sound = readSound(path, limits);
  if (sound) return "";
  EXPECT_EQ(sound.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(sound.error().place, path.string());
  return sound.error().message;
}

TEST(ReadSound, EachBadFileHasItsOwnMessage) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint(folder / "none.wav"), HasSubstr("no such sound file"));
  EXPECT_THAT(complaint(folder.path()), HasSubstr("folder"));
  test::writeText(folder / "empty.wav", "");
  EXPECT_THAT(complaint(folder / "empty.wav"), HasSubstr("empty"));
  test::writeText(folder / "text.wav", "this is no sound at all, but a line of text\n");
  EXPECT_THAT(complaint(folder / "text.wav"), HasSubstr("not a sound"));
  // libsndfile takes these on their names' word, as headerless telephone speech.
  test::writeText(folder / "text.vox", "this is no sound at all, but a line of text\n");
  EXPECT_NE(complaint(folder / "text.vox"), "");
  writeFile(folder / "nothing.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1, {});
  EXPECT_THAT(complaint(folder / "nothing.wav"), HasSubstr("no samples"));
  writeFile(folder / "silent.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1,
            std::vector<float>(1000, 2e-5F));
  EXPECT_THAT(complaint(folder / "silent.wav"), HasSubstr("silent"));
  writeFile(folder / "slow.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 100, 1, tone(100, 1, 1));
  EXPECT_THAT(complaint(folder / "slow.wav"), HasSubstr("100 Hz"));
}

TEST(ReadSound, NamesTheSampleThatIsNoNumber) {
  const TemporaryFolder folder;
  auto values = tone(44100, 2, 1);
  values[2 * 30000 + 1] = std::numeric_limits<float>::quiet_NaN();
  writeFile(folder / "nan.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 44100, 2, values);
  EXPECT_THAT(complaint(folder / "nan.wav"), HasSubstr("sample 30000 of channel 2"));
  values[2 * 7] = std::numeric_limits<float>::infinity();
  writeFile(folder / "inf.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 44100, 2, values);
  EXPECT_THAT(complaint(folder / "inf.wav"), HasSubstr("sample 7 of channel 1"));
}

TEST(ReadSound, IsBounded) {
  const TemporaryFolder folder;
  writeFile(folder / "a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 8000, 2, tone(8000, 2, 3));
  SoundLimits limits;
  limits.maxSeconds = 2;
  EXPECT_THAT(complaint(folder / "a.wav", limits), HasSubstr("longer than 2 s"));
  limits = {};
  limits.maxBytes = 8000;
  EXPECT_THAT(complaint(folder / "a.wav", limits), HasSubstr("MiB"));
  EXPECT_EQ(complaint(folder / "a.wav"), "");
}

TEST(ReadSound, TakesACutOffFileForWhatItHolds) {
  const TemporaryFolder folder;
  writeFile(folder / "a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 44100, 1, tone(44100, 1, 1));
  std::filesystem::resize_file(folder / "a.wav", 44 + 2 * 22050);
  const auto sound = readSound(folder / "a.wav");
  ASSERT_TRUE(sound) << sound.error().text();
  EXPECT_NEAR(sound->duration(), 0.5, 0.001);
}

TEST(ReadSound, SurvivesDamage) {
  // No crash, and never a sample that is no number, whatever the bytes. Without Ogg: libsndfile
  // 1.2.0 leaks where it gives up on one, which a leak checker would hold against us.
  const TemporaryFolder folder;
  for (const auto& [name, format] :
       std::vector<std::pair<std::string, int>>{{"a.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT},
                                                {"a.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16}}) {
    writeFile(folder / name, format, 22050, 1, tone(22050, 1, 0.1));
    const std::string good = test::readText(folder / name);
    for (std::size_t i = 0; i < 60; ++i) {
      std::string bad = good;
      bad[(i * i * 7) % bad.size()] ^= static_cast<char>(0x5A + i);
      test::writeText(folder / name, bad);
      if (const auto sound = readSound(folder / name)) {
        EXPECT_FALSE(sound->samples.empty());
        EXPECT_TRUE(std::isfinite(peakOf(*sound)));
      }
    }
  }
}

class WritesBack : public testing::TestWithParam<int> {};

TEST_P(WritesBack, SamplesUnchangedAfterTheSilence) {
  const TemporaryFolder folder;
  for (const int channels : {1, 2, 5}) {
    const int container = channels > 2 ? SF_FORMAT_WAVEX : SF_FORMAT_WAV;
    auto values = tone(48000, channels, 0.2);
    values[0] = 1.0F;  // clipped in integers: the largest value there is
    values[static_cast<std::size_t>(channels)] = -1.0F;
    writeFile(folder / "in.wav", container | GetParam(), 48000, channels, values);
    const auto sound = readSound(folder / "in.wav");
    ASSERT_TRUE(sound);
    ASSERT_TRUE(writeWav(folder / "out.wav", *sound, 0.25));
    const auto back = readSound(folder / "out.wav");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->format, sound->format);
    EXPECT_EQ(back->channels, channels);
    ASSERT_EQ(back->samples.size(), sound->samples.size() + 12000);
    for (std::size_t i = 0; i < 12000; ++i) ASSERT_EQ(back->samples[i], 0.0F);
    const auto& before = channels == 1 ? sound->samples : sound->interleaved;
    const auto& after = channels == 1 ? back->samples : back->interleaved;
    const std::vector<float> tail(after.end() - static_cast<std::ptrdiff_t>(before.size()),
                                  after.end());
    EXPECT_EQ(tail, before);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, WritesBack,
                         testing::Values(SF_FORMAT_PCM_16, SF_FORMAT_PCM_24, SF_FORMAT_FLOAT));

TEST(WriteWav, TheSameSoundGivesTheSameBytes) {
  const TemporaryFolder folder;
  writeFile(folder / "in.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 8000, 1, tone(8000, 1, 0.1));
  const auto sound = readSound(folder / "in.wav");
  ASSERT_TRUE(sound);
  ASSERT_TRUE(writeWav(folder / "a.wav", *sound));
  ASSERT_TRUE(writeWav(folder / "b.wav", *sound));
  EXPECT_EQ(test::readText(folder / "a.wav"), test::readText(folder / "b.wav"));
}

TEST(WriteWav, LeavesNothingWhereItCannotWrite) {
  const TemporaryFolder folder;
  Sound sound;
  sound.rate = 8000;
  sound.samples = {0.5F};
  const auto written = writeWav(folder / "missing" / "out.wav", sound);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kBadInput);
  EXPECT_FALSE(writeWav(folder / "huge.wav", sound, 1e9));
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace ifa
