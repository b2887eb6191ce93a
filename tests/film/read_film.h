// SPDX-License-Identifier: Apache-2.0
// Films taken apart again, for tests: decoded with libav as a player does it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace ifa::test {

struct Fraction {
  std::int64_t numerator = 0, denominator = 1;
  bool operator==(const Fraction& other) const {
    return numerator * other.denominator == other.numerator * denominator;
  }
  friend void PrintTo(const Fraction& it, std::ostream* stream) {
    *stream << it.numerator << '/' << it.denominator;
  }
};

/// One decoded frame, 4:2:0.
struct DecodedFrame {
  Fraction time;  ///< s
  bool isKey = false;
  int width = 0;
  std::vector<std::uint8_t> y, u, v;

  /// Red, green and blue of a pixel by BT.709 in the range of video, worked out here by hand.
  [[nodiscard]] std::array<double, 3> rgbAt(int column, int row) const;
};

struct DecodedFilm {
  std::string videoCodec, soundCodec;  ///< empty without such a track
  int width = 0, height = 0;
  Fraction frameRate;
  double duration = 0;  ///< s, of the whole file
  Fraction videoDuration, soundDuration;
  std::array<int, 4> colourTags{};  ///< primaries, transfer, matrix, range
  std::vector<DecodedFrame> frames;
  int soundRate = 0;
  std::int64_t firstSample = 0;           ///< time of the first decoded sample, in samples
  std::vector<std::vector<float>> sound;  ///< of each channel, from firstSample on
};

/// Throws when the film cannot be read to its end.
[[nodiscard]] DecodedFilm readFilm(const std::filesystem::path& path);

/// Names of the outermost boxes of an MP4 file, in their order.
[[nodiscard]] std::vector<std::string> boxesOf(const std::filesystem::path& path);

}  // namespace ifa::test
