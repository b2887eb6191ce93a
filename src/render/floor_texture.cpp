// SPDX-License-Identifier: Apache-2.0
#include "render/floor_texture.h"

#include <algorithm>
#include <cstddef>
#include <functional>

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

float mixed(float a, float b, float share) { return a + share * (b - a); }

/// Smooth noise in [0, 1] on a lattice that repeats with the tile.
class Noise {
 public:
  Noise(int columns, int rows, std::uint32_t seed) : columns_(columns), rows_(rows) {
    // One column and row more than there are cells: the first ones again.
    for (int y = 0; y <= rows; ++y) {
      for (int x = 0; x <= columns; ++x) {
        values_.push_back(unit(hashed(static_cast<std::uint32_t>(x % columns),
                                      static_cast<std::uint32_t>(y % rows), seed)));
      }
    }
  }
  /// @param u, v  in [0, 1)
  float operator()(float u, float v) const {
    const float x = u * static_cast<float>(columns_), y = v * static_cast<float>(rows_);
    const auto i = static_cast<int>(x), k = static_cast<int>(y);
    const float a = eased(x - static_cast<float>(i)), b = eased(y - static_cast<float>(k));
    const float* corner = values_.data() + static_cast<std::ptrdiff_t>(k) * (columns_ + 1) + i;
    const float* above = corner + columns_ + 1;
    return mixed(mixed(corner[0], corner[1], a), mixed(above[0], above[1], a), b);
  }

 private:
  static float eased(float t) { return t * t * (3 - 2 * t); }

  int columns_, rows_;
  std::vector<float> values_;
};

Colour mixed(const Colour& a, const Colour& b, float share) { return a + share * (b - a); }

/// Wood whose grain runs along u. `seed` makes another piece of the same wood.
class Wood {
 public:
  Wood(std::uint32_t seed, const Colour& light, const Colour& dark)
      : light_(light),
        dark_(dark),
        wander_{{{2, 3, seed}, {5, 9, seed + 1}, {9, 40, seed + 2}}},
        streaks_(6, 300, seed + 3),
        fibres_(40, 1024, seed + 4),
        pores_(40, 640, seed + 5) {}

  [[nodiscard]] Colour at(float u, float v) const {
    const float wander = wander_[0](u, v) + 0.35f * wander_[1](u, v) + 0.08f * wander_[2](u, v);
    const float phase = 26 * v + 3.2f * wander;
    // Early wood fades into late wood, then the next year begins.
    const float ring = phase - std::floor(phase);
    const float late = smoothStep(0.1f, 0.9f, ring) * (1 - smoothStep(0.9f, 1.0f, ring));
    const float share = 0.26f * late + 0.44f * streaks_(u, v) + 0.3f * fibres_(u, v);
    return mixed(light_, dark_, share) * (1 - 0.22f * smoothStep(0.8f, 0.95f, pores_(u, v)));
  }

 private:
  Colour light_, dark_;
  std::array<Noise, 3> wander_;
  Noise streaks_, fibres_, pores_;
};

using Painter = std::function<Colour(float, float)>;

Painter desk() {
  const Wood wood(11, {0.335f, 0.205f, 0.115f}, {0.215f, 0.118f, 0.060f});
  return [wood](float u, float v) { return wood.at(u, v); };
}

Painter boards() {
  constexpr std::uint32_t kBoards = 5;
  std::vector<Wood> woods;
  for (std::uint32_t i = 0; i < kBoards; ++i) {
    woods.emplace_back(100 + 16 * i, Colour(0.520f, 0.345f, 0.190f),
                       Colour(0.375f, 0.220f, 0.110f));
  }
  return [woods](float u, float v) {
    const float place = v * kBoards;
    const auto board = static_cast<std::uint32_t>(place) % kBoards;
    const float within = place - std::floor(place), edge = std::min(within, 1 - within);
    float end = std::abs(u - unit(hashed(board, 7, 3)));  // where a board ends
    end = std::min(end, 1 - end) * kBoards;
    const float tone = 0.86f + 0.28f * unit(hashed(board, 1, 5));
    const float gap = smoothStep(0.004f, 0.011f, std::min(edge, end));
    return Colour(woods[board].at(u, v) * tone * (0.25f + 0.75f * gap));
  };
}

Painter carpet() {
  // Rows of loops, each a little out of its place.
  constexpr int kLoops = 192;
  const Noise sideways(96, 96, 21), along(96, 96, 22), fleece(700, 700, 23), wear(5, 5, 24);
  return [=](float u, float v) {
    const float row = v * kLoops, shift = 0.5f * static_cast<float>(static_cast<int>(row) % 2);
    const float x = u * kLoops + shift + 0.5f * sideways(u, v), y = row + 0.5f * along(u, v);
    const float a = x - std::floor(x) - 0.5f, b = y - std::floor(y) - 0.5f;
    const float loop = 1 - smoothStep(0.05f, 0.55f, std::sqrt(a * a + 0.8f * b * b));
    const float yarn = unit(
        hashed(static_cast<std::uint32_t>(x) % kLoops, static_cast<std::uint32_t>(y) % kLoops, 9));
    const float light =
        (0.45f + 0.55f * loop) * (0.8f + 0.3f * fleece(u, v)) * (0.86f + 0.22f * yarn);
    return Colour(Colour(0.235f, 0.262f, 0.300f) * light * (0.9f + 0.2f * wear(u, v)));
  };
}

}  // namespace

FloorTexture::FloorTexture(const std::string& surface) : gloss_(0.14f) {
  if (surface == "wood") gloss_ = 0.2f;
  if (surface == "carpet") gloss_ = 0;
  const Painter colourAt = surface == "wood" ? boards() : (surface == "carpet" ? carpet() : desk());
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
