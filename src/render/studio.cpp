// SPDX-License-Identifier: Apache-2.0
#include "render/studio.h"

#include <algorithm>

namespace ifa::render {
namespace {

// The key light: where it stands, seen from the subject with x to the camera's right, y away from
// the camera, z up; half its side as a tangent; its radiance.
const Vector kKeyPlace(-0.62f, 0.1f, 0.85f);
constexpr float kKeyHalf = 0.13f;
const Colour kKeyRadiance = Colour(1.0f, 0.955f, 0.88f) * 43;
// The rim over which the key light fades, as a share of half its side.
constexpr float kKeyRim = 0.12f;
// Half the side of all that is lit.
constexpr float kKeyReach = kKeyHalf * (1 + kKeyRim);

const Colour kZenith = Colour(0.92f, 0.96f, 1.04f) * 0.53f;
const Colour kHorizon = Colour(1.0f, 0.98f, 0.94f) * 0.31f;

// Two dim panels that only shiny things show: behind on the right, and low on the camera's side.
struct Panel {
  Vector towards;
  float halfWidth, halfHeight, radiance;
};
const std::array<Panel, 2> kPanels = {
    {{{0.85f, 0.45f, 0.42f}, 0.16f, 0.5f, 2.2f}, {{-0.2f, -0.9f, 0.55f}, 0.7f, 0.2f, 0.9f}}};

/// 1 inside the square of half side 1, fading to 0 over a rim on both sides of its edge.
float insideSquare(float x, float y, float rim) {
  return (1 - smoothStep(1 - rim, 1 + rim, std::abs(x))) *
         (1 - smoothStep(1 - rim, 1 + rim, std::abs(y)));
}

std::array<float, 9> harmonicsAt(const Vector& d) {
  return {0.282095f,
          0.488603f * d.y(),
          0.488603f * d.z(),
          0.488603f * d.x(),
          1.092548f * d.x() * d.y(),
          1.092548f * d.y() * d.z(),
          0.315392f * (3 * d.z() * d.z() - 1),
          1.092548f * d.x() * d.z(),
          0.546274f * (d.x() * d.x() - d.y() * d.y())};
}

/// Calls `use(direction, solid angle)` for directions that fill the sphere.
template <class Use>
void overSphere(const Use& use) {
  constexpr int kRows = 96, kColumns = 192;
  for (int row = 0; row < kRows; ++row) {
    const float z = 1 - 2 * (static_cast<float>(row) + 0.5f) / kRows;
    for (int column = 0; column < kColumns; ++column) {
      const float angle = 2 * kPi * (static_cast<float>(column) + 0.5f) / kColumns;
      const float r = std::sqrt(1 - z * z);
      use(Vector(r * std::cos(angle), r * std::sin(angle), z), 4 * kPi / (kRows * kColumns));
    }
  }
}

}  // namespace

Studio::Studio(float azimuth, const Colour& floorAlbedo)
    : right_(std::sin(azimuth), -std::cos(azimuth), 0),
      forward_(std::cos(azimuth), std::sin(azimuth), 0),
      floorAlbedo_(floorAlbedo) {
  const Vector place = kKeyPlace.x() * right_ + kKeyPlace.y() * forward_;
  keyFrame_ = Frame((place + Vector(0, 0, kKeyPlace.z())).normalized());
  // Sides level and upright, as a window's.
  keyFrame_.tangent = Vector::UnitZ().cross(keyFrame_.normal).normalized();
  keyFrame_.bitangent = keyFrame_.normal.cross(keyFrame_.tangent);
  integrate();
}

void Studio::integrate() {
  constexpr int kCells = 32;
  keyOnFloor_ = Colour::Zero();
  for (int i = 0; i < kCells * kCells; ++i) {
    const int column = i % kCells, row = i / kCells;
    const Vector d = towardsKey((static_cast<float>(column) + 0.5f) / kCells,
                                (static_cast<float>(row) + 0.5f) / kCells);
    keyOnFloor_ += key(d) * d.z() / keyDensity(d) / (kCells * kCells);
  }
  skyOnFloor_ = Colour::Zero();
  overSphere([&](const Vector& d, float solid) {
    if (d.z() > 0) skyOnFloor_ += sky(d) * d.z() * solid;
  });
  floorRadiance_ = floorAlbedo_ / kPi * (keyOnFloor_ + skyOnFloor_);
  harmonics_.fill(Colour::Zero());
  overSphere([&](const Vector& d, float solid) {
    const Colour radiance = d.z() > 0 ? sky(d) : floorRadiance_;
    const auto basis = harmonicsAt(d);
    for (std::size_t i = 0; i < 9; ++i) harmonics_[i] += radiance * basis[i] * solid;
  });
  // The clamped cosine as an operator on the bands.
  for (std::size_t i = 0; i < 9; ++i) {
    harmonics_[i] *= i == 0 ? kPi : (i < 4 ? 2 * kPi / 3 : kPi / 4);
  }
}

Colour Studio::softSky(const Vector& d) const {
  const float height = std::max(d.z(), 0.0f);
  // Brighter on the key's side, so that no two sides of a body look the same.
  const float side = 1 - 0.22f * d.dot(right_) - 0.12f * d.dot(forward_);
  return (kHorizon + (kZenith - kHorizon) * std::sqrt(height)) * side;
}

Colour Studio::sky(const Vector& d) const {
  Colour light = softSky(d);
  for (const Panel& panel : kPanels) {
    const Vector towards = (panel.towards.x() * right_ + panel.towards.y() * forward_ +
                            Vector(0, 0, panel.towards.z()))
                               .normalized();
    const float along = d.dot(towards);
    if (along <= 0) continue;
    const Vector across = Vector::UnitZ().cross(towards).normalized();
    const float x = d.dot(across) / along / panel.halfWidth;
    const float y = d.dot(towards.cross(across)) / along / panel.halfHeight;
    if (std::abs(x) < 1.4f && std::abs(y) < 1.4f) {
      light += panel.radiance * insideSquare(x, y, 0.3f);
    }
  }
  return light;
}

Colour Studio::key(const Vector& d) const {
  const float along = d.dot(keyFrame_.normal);
  if (along <= 0) return Colour::Zero();
  const float x = d.dot(keyFrame_.tangent) / along / kKeyHalf;
  const float y = d.dot(keyFrame_.bitangent) / along / kKeyHalf;
  if (std::abs(x) > 1 + kKeyRim || std::abs(y) > 1 + kKeyRim) return Colour::Zero();
  return kKeyRadiance * insideSquare(x, y, kKeyRim);
}

Vector Studio::towardsKey(float u, float v) const {
  return keyFrame_.toWorld((2 * u - 1) * kKeyReach, (2 * v - 1) * kKeyReach, 1).normalized();
}

float Studio::keyDensity(const Vector& d) const {
  const float along = d.dot(keyFrame_.normal);
  if (along <= 0) return 0;
  const float x = d.dot(keyFrame_.tangent) / along, y = d.dot(keyFrame_.bitangent) / along;
  if (std::abs(x) > kKeyReach || std::abs(y) > kKeyReach) return 0;
  return 1 / (4 * kKeyReach * kKeyReach * along * along * along);
}

float Studio::keyAngle() const { return std::atan(kKeyReach * std::sqrt(2.0f)); }

Colour Studio::ambient(const Vector& normal) const {
  const auto basis = harmonicsAt(normal);
  Colour sum = Colour::Zero();
  for (std::size_t i = 0; i < 9; ++i) sum += harmonics_[i] * basis[i];
  return sum.max(0.0f);
}

Colour Studio::keyIrradiance(const Vector& normal) const {
  const float cosine = std::max(0.0f, normal.dot(keyFrame_.normal));
  return keyOnFloor_ * (cosine / keyFrame_.normal.z());
}

}  // namespace ifa::render
