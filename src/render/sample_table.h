// SPDX-License-Identifier: Apache-2.0
// Where and when the rays of a pixel go: the same well-spread points in every frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ifa::render {

/// Number of instants at which poses within one shutter opening are known.
inline constexpr int kInstants = 64;

/// The random numbers of one sample, even over a pixel's samples.
struct Sample {
  float x = 0, y = 0;                  ///< place in the pixel, in [0, 1)
  float key0 = 0, key1 = 0;            ///< place on the key light, in [0, 1)
  float diffuseX = 0, diffuseY = 0;    ///< in the unit disc: direction of the diffuse bounce
  float specularX = 0, specularY = 0;  ///< likewise, of the specular bounce
  float choice = 0;                    ///< in [0, 1): whether a body that fades in is there
  std::uint8_t instant = 0;            ///< 0 to kInstants - 1
};

/// Owen-scrambled Sobol points (Burley, "Practical Hash-based Owen Scrambling", JCGT 2020). The
/// pixels of an 8 by 8 tile have consecutive blocks of one sequence, so that neighbours together
/// are even too (interleaved sampling, Keller and Heidrich 2001).
class SampleTable {
 public:
  static constexpr int kTile = 8;

  /// @param perPixel  a power of two, 1 to 1024
  explicit SampleTable(int perPixel);

  [[nodiscard]] int perPixel() const { return perPixel_; }
  /// The samples of the pixel at (x, y), perPixel() of them.
  [[nodiscard]] const Sample* at(int x, int y) const { return samples_.data() + indexAt(x, y); }
  /// Where these lie among all().
  [[nodiscard]] std::size_t indexAt(int x, int y) const {
    const auto block = static_cast<std::size_t>((y & (kTile - 1)) * kTile + (x & (kTile - 1)));
    return block * static_cast<std::size_t>(perPixel_);
  }
  /// The samples of a whole tile.
  [[nodiscard]] const std::vector<Sample>& all() const { return samples_; }

 private:
  int perPixel_;
  std::vector<Sample> samples_;
};

}  // namespace ifa::render
