// SPDX-License-Identifier: Apache-2.0
#include "render/floor_texture.h"

#include <algorithm>

#include "base/parallel.h"

namespace ifa::render {
namespace {

constexpr float kTile = 0.512f;  // m
constexpr int kSide = 2048;

std::uint32_t hashed(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ seed * 0xcb1ab31fu;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  h *= 0x297a2d39u;
  return h ^ (h >> 15);
}

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

int wrapped(int i, int period) { return ((i % period) + period) % period; }

/// Smooth noise in [0, 1] on a lattice of `columns` by `rows` cells that repeats with the tile.
float noise(float u, float v, int columns, int rows, std::uint32_t seed) {
  const float x = u * static_cast<float>(columns), y = v * static_cast<float>(rows);
  const int i = static_cast<int>(std::floor(x)), k = static_cast<int>(std::floor(y));
  const float a = smoothStep(0, 1, x - static_cast<float>(i));
  const float b = smoothStep(0, 1, y - static_cast<float>(k));
  const auto corner = [&](int di, int dk) {
    return unit(hashed(static_cast<std::uint32_t>(wrapped(i + di, columns)),
                       static_cast<std::uint32_t>(wrapped(k + dk, rows)), seed));
  };
  return (corner(0, 0) * (1 - a) + corner(1, 0) * a) * (1 - b) +
         (corner(0, 1) * (1 - a) + corner(1, 1) * a) * b;
}

Colour mixed(const Colour& a, const Colour& b, float share) { return a + share * (b - a); }

/// Wood whose grain runs along u. `seed` makes another piece of the same wood.
Colour grain(float u, float v, std::uint32_t seed, const Colour& light, const Colour& dark) {
  const float wander = noise(u, v, 2, 3, seed) + 0.35f * noise(u, v, 5, 9, seed + 1) +
                       0.08f * noise(u, v, 9, 40, seed + 2);
  const float phase = 26 * v + 3.2f * wander;
  const float ring =
      phase - std::floor(phase);  // early wood fades into late wood, then starts anew
  const float late = smoothStep(0.1f, 0.9f, ring) * (1 - smoothStep(0.9f, 1.0f, ring));
  const float streaks = noise(u, v, 6, 300, seed + 3), fibres = noise(u, v, 40, 1024, seed + 4);
  const float pores = smoothStep(0.8f, 0.95f, noise(u, v, 40, 640, seed + 5));
  const float share = 0.4f * late + 0.38f * streaks + 0.22f * fibres;
  return mixed(light, dark, share) * (1 - 0.22f * pores);
}

Colour deskAt(float u, float v) {
  return grain(u, v, 11, {0.335f, 0.205f, 0.115f}, {0.215f, 0.118f, 0.060f});
}

Colour boardAt(float u, float v) {
  constexpr int kBoards = 5;
  const float place = v * kBoards;
  const auto board = static_cast<std::uint32_t>(place) % kBoards;
  const float edge = std::min(place - std::floor(place), 1 - (place - std::floor(place)));
  const float joint = unit(hashed(board, 7, 3));  // where a board ends
  float end = std::abs(u - joint);
  end = std::min(end, 1 - end) * kBoards;
  const float tone = 0.86f + 0.28f * unit(hashed(board, 1, 5));
  const float gap = smoothStep(0.004f, 0.011f, std::min(edge, end));
  const Colour wood =
      grain(u, v, 100 + 16 * board, {0.520f, 0.345f, 0.190f}, {0.375f, 0.220f, 0.110f});
  return wood * tone * (0.25f + 0.75f * gap);
}

Colour carpetAt(float u, float v) {
  // Rows of loops, each a little out of its place.
  constexpr int kLoops = 192;
  const float row = v * kLoops;
  const float shift = 0.5f * static_cast<float>(static_cast<int>(row) % 2);
  const float x = u * kLoops + shift + 0.5f * noise(u, v, 96, 96, 21);
  const float y = row + 0.5f * noise(u, v, 96, 96, 22);
  const float a = x - std::floor(x) - 0.5f, b = y - std::floor(y) - 0.5f;
  const float loop = 1 - smoothStep(0.05f, 0.55f, std::sqrt(a * a + 0.8f * b * b));
  const float yarn = unit(hashed(static_cast<std::uint32_t>(wrapped(static_cast<int>(x), kLoops)),
                                 static_cast<std::uint32_t>(static_cast<int>(y) % kLoops), 9));
  const float fleece = noise(u, v, 700, 700, 23), wear = noise(u, v, 5, 5, 24);
  const float light = (0.45f + 0.55f * loop) * (0.8f + 0.3f * fleece) * (0.86f + 0.22f * yarn);
  return Colour(0.235f, 0.262f, 0.300f) * light * (0.9f + 0.2f * wear);
}

}  // namespace

FloorTexture::FloorTexture(const std::string& surface) : gloss_(0.14f) {
  auto* colourAt = &deskAt;
  if (surface == "wood") colourAt = &boardAt, gloss_ = 0.2f;
  if (surface == "carpet") colourAt = &carpetAt, gloss_ = 0;
  Level full{kSide, {}};
  full.texels.resize(static_cast<std::size_t>(kSide) * kSide);
  parallelFor(kSide, [&](std::size_t row) {
    for (int i = 0; i < kSide; ++i) {
      const Colour c = colourAt((static_cast<float>(i) + 0.5f) / kSide,
                                (static_cast<float>(row) + 0.5f) / kSide);
      auto& texel = full.texels[row * kSide + static_cast<std::size_t>(i)];
      for (int k = 0; k < 3; ++k) {
        texel[static_cast<std::size_t>(k)] =
            static_cast<std::uint8_t>(std::lround(255 * std::sqrt(std::clamp(c[k], 0.0f, 1.0f))));
      }
    }
  });
  levels_.push_back(std::move(full));
  shrink();
}

void FloorTexture::shrink() {
  while (levels_.back().side > 1) {
    const Level& from = levels_.back();
    Level to{from.side / 2, {}};
    to.texels.resize(static_cast<std::size_t>(to.side) * static_cast<std::size_t>(to.side));
    for (int y = 0; y < to.side; ++y) {
      for (int x = 0; x < to.side; ++x) {
        for (std::size_t k = 0; k < 3; ++k) {
          float sum = 0;
          for (int corner = 0; corner < 4; ++corner) {
            const auto index =
                static_cast<std::size_t>((2 * y + corner / 2) * from.side + 2 * x + corner % 2);
            const auto root = static_cast<float>(from.texels[index][k]);
            sum += 0.25f * root * root;
          }
          to.texels[static_cast<std::size_t>(y * to.side + x)][k] =
              static_cast<std::uint8_t>(std::lround(std::sqrt(sum)));
        }
      }
    }
    levels_.push_back(std::move(to));
  }
  mean_ = bilinear(levels_.back(), 0, 0);
}

Colour FloorTexture::bilinear(const Level& level, float u, float v) const {
  const float x = u * static_cast<float>(level.side) - 0.5f;
  const float y = v * static_cast<float>(level.side) - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y);
  const int mask = level.side - 1;
  const int x0 = static_cast<int>(fx) & mask, y0 = static_cast<int>(fy) & mask;
  const int x1 = (x0 + 1) & mask, y1 = (y0 + 1) & mask;
  const float a = x - fx, b = y - fy;
  const auto texel = [&](int i, int k) {
    const auto& t = level.texels[static_cast<std::size_t>(k * level.side + i)];
    return Colour(t[0], t[1], t[2]);
  };
  const Colour root = (texel(x0, y0) * (1 - a) + texel(x1, y0) * a) * (1 - b) +
                      (texel(x0, y1) * (1 - a) + texel(x1, y1) * a) * b;
  return root.square() * (1.0f / (255 * 255));
}

Colour FloorTexture::trilinear(float u, float v, float level) const {
  const auto last = static_cast<float>(levels_.size() - 1);
  const float clamped = std::clamp(level, 0.0f, last);
  const auto lower = static_cast<std::size_t>(clamped);
  const float share = clamped - static_cast<float>(lower);
  const Colour c = bilinear(levels_[lower], u, v);
  if (share == 0 || lower + 1 >= levels_.size()) return c;
  return mixed(c, bilinear(levels_[lower + 1], u, v), share);
}

Colour FloorTexture::at(float x, float y, float across, const Eigen::Vector2f& along) const {
  const float level = std::log2(std::max(across, 1e-6f) * kSide / kTile);
  const int taps = std::clamp(static_cast<int>(std::lround(along.norm() / across)), 1, 6);
  Colour sum = Colour::Zero();
  for (int tap = 0; tap < taps; ++tap) {
    const float share = (static_cast<float>(tap) + 0.5f) / static_cast<float>(taps) - 0.5f;
    sum += trilinear((x + share * along.x()) / kTile, (y + share * along.y()) / kTile, level);
  }
  return sum / static_cast<float>(taps);
}

}  // namespace ifa::render
