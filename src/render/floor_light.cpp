// SPDX-License-Identifier: Apache-2.0
#include "render/floor_light.h"

#include <algorithm>
#include <limits>

namespace ifa::render {
namespace {

// A body darkens the sky by less than a hundredth beyond this many radii, and fades out there.
constexpr float kAmbientReach = 5;
constexpr float kFadeFrom = 0.7f;  // of the reach
// What shades at distance d is filtered over this times d, for the sky.
constexpr float kAmbientWidth = 0.22f;
constexpr int kWidestFilter = 5;    // points to each side
constexpr int kSearch = 3;          // points to each side in which what shades is looked for
constexpr float kMostPoints = 700;  // of a grid's side

/// Sum over hits of 1 / distance, and their number.
struct Blockers {
  float inverse = 0, hits = 0;
};

template <class T>
FloorGrid<T> gridAround(float x, float y, float reach, float step) {
  FloorGrid<T> grid;
  grid.step = std::max(step, 2 * reach / kMostPoints);
  // On a raster that does not move with the body, so that nothing shimmers.
  grid.left = std::floor((x - reach) / grid.step) * grid.step;
  grid.low = std::floor((y - reach) / grid.step) * grid.step;
  grid.columns = static_cast<int>(std::ceil(2 * reach / grid.step)) + 2;
  grid.rows = grid.columns;
  grid.values.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  return grid;
}

/// Calls `filter(first, stride, count)` for each row of a grid, then for each column: where its
/// points are among all, and how many they are.
template <class Filter>
void alongBothSides(int columns, int rows, const Filter& filter) {
  for (int row = 0; row < rows; ++row) filter(row * columns, 1, columns);
  for (int column = 0; column < columns; ++column) filter(column, columns, rows);
}

/// Sums over a window of `kSearch` points to each side, along both sides.
void spread(int columns, int rows, std::vector<Blockers>& blockers) {
  std::vector<Blockers> line;
  const auto filter = [&](int first, int stride, int count) {
    line.assign(static_cast<std::size_t>(count), {});
    for (int i = 0; i < count; ++i) {
      for (int k = std::max(0, i - kSearch); k <= std::min(count - 1, i + kSearch); ++k) {
        const Blockers& b = blockers[static_cast<std::size_t>(first + k * stride)];
        line[static_cast<std::size_t>(i)].inverse += b.inverse;
        line[static_cast<std::size_t>(i)].hits += b.hits;
      }
    }
    for (int i = 0; i < count; ++i) {
      blockers[static_cast<std::size_t>(first + i * stride)] = line[static_cast<std::size_t>(i)];
    }
  };
  alongBothSides(columns, rows, filter);
}

/// Tent filter whose half-width, in points, differs from place to place; along one side, then the
/// other.
template <class T>
void blur(FloorGrid<T>& grid, const std::vector<float>& widths, const T& zero) {
  std::vector<T> line;
  const auto filter = [&](int first, int stride, int count) {
    line.assign(static_cast<std::size_t>(count), zero);
    for (int i = 0; i < count; ++i) {
      const float width = widths[static_cast<std::size_t>(first + i * stride)];
      T sum = grid.values[static_cast<std::size_t>(first + i * stride)];
      float weights = 1;
      const int reach = static_cast<int>(width);
      for (int k = -reach; k <= reach; ++k) {
        if (k == 0 || i + k < 0 || i + k >= count) continue;
        const float weight = 1 - static_cast<float>(std::abs(k)) / (width + 1);
        sum += grid.values[static_cast<std::size_t>(first + (i + k) * stride)] * weight;
        weights += weight;
      }
      line[static_cast<std::size_t>(i)] = sum * (1 / weights);
    }
    for (int i = 0; i < count; ++i) {
      grid.values[static_cast<std::size_t>(first + i * stride)] = line[static_cast<std::size_t>(i)];
    }
  };
  alongBothSides(grid.columns, grid.rows, filter);
}

/// Filter widths in the grid's points for a penumbra that is `slope` times as wide as the blocker
/// is far.
template <class T>
std::vector<float> widthsFor(std::vector<Blockers> blockers, const FloorGrid<T>& grid,
                             float slope) {
  spread(grid.columns, grid.rows, blockers);
  std::vector<float> widths;
  widths.reserve(blockers.size());
  for (const Blockers& b : blockers) {
    const float distance = b.inverse > 0 ? b.hits / b.inverse : 0;
    widths.push_back(std::min(slope * distance / grid.step, static_cast<float>(kWidestFilter)));
  }
  return widths;
}

}  // namespace

FloorLight::FloorLight(const ActorMoment& actor, const Studio& studio, const SampleTable& samples,
                       const FloorLightSettings& settings) {
  if (actor.presence() <= 0) return;
  lightKey(actor, studio, samples, settings);
  lightAmbient(actor, studio, samples, settings);
}

void FloorLight::lightKey(const ActorMoment& actor, const Studio& studio,
                          const SampleTable& samples, const FloorLightSettings& settings) {
  const Vector& towards = studio.keyDirection();
  const float height = actor.centre().z() / towards.z();
  const float softness = std::tan(studio.keyAngle());
  const float penumbra = std::max(0.0f, actor.lowest() - actor.radius()) * softness;
  const float step =
      std::max({settings.pixel, actor.radius() / settings.keyFineness, penumbra / 5});
  const float reach = (actor.reach() + height * softness) / towards.z() + 4 * step;
  key_ = gridAround<float>(actor.centre().x() - height * towards.x(),
                           actor.centre().y() - height * towards.y(), reach, step);
  std::vector<Blockers> blockers(key_.values.size());
  const int count = std::min(settings.keyRays, samples.perPixel());
  struct TowardsKey {
    Vector direction;
    float light;
  };
  std::vector<TowardsKey> towardsKey;
  towardsKey.reserve(samples.all().size());
  for (const Sample& s : samples.all()) {
    const Vector d = studio.towardsKey(s.key0, s.key1);
    towardsKey.push_back({d, studio.key(d).x()});
  }
  for (int row = 0; row < key_.rows; ++row) {
    for (int column = 0; column < key_.columns; ++column) {
      const Vector place(key_.left + (static_cast<float>(column) + 0.5f) * key_.step,
                         key_.low + (static_cast<float>(row) + 0.5f) * key_.step, 0);
      const auto index = static_cast<std::size_t>(row * key_.columns + column);
      const std::size_t first = samples.indexAt(column, row);
      Blockers& blocked = blockers[index];
      float light = 0, shaded = 0;
      for (std::size_t i = first; i < first + static_cast<std::size_t>(count); ++i) {
        const Sample& s = samples.all()[i];
        light += towardsKey[i].light;
        if (s.choice >= actor.presence()) continue;
        const float distance = actor.distance({place, towardsKey[i].direction}, s.instant);
        if (distance == std::numeric_limits<float>::infinity()) continue;
        shaded += towardsKey[i].light;
        blocked.hits += 1;
        blocked.inverse += 1 / std::max(distance, 1e-5f);
      }
      key_.values[index] = 1 - shaded / std::max(light, 1e-6f);
    }
  }
  blur(key_, widthsFor(std::move(blockers), key_, 0.7f * softness), 0.0f);
}

void FloorLight::lightAmbient(const ActorMoment& actor, const Studio& studio,
                              const SampleTable& samples, const FloorLightSettings& settings) {
  const float height = std::max(0.0f, actor.lowest() - actor.radius());
  const float seen = actor.radius() / std::max(actor.lowest(), actor.radius());
  if (seen * seen < 0.006f) return;  // too high to matter
  const float step =
      std::max({settings.pixel, actor.radius() / settings.ambientFineness, 0.15f * height});
  const float reach = actor.reach() + (kAmbientReach - 1) * actor.radius() + 0.5f * height;
  const Vector& centre = actor.centre();
  ambient_ = gridAround<Colour>(centre.x(), centre.y(), reach, step);
  std::vector<Blockers> blockers(ambient_.values.size());
  const int count = std::min(settings.ambientRays, samples.perPixel());
  const Frame up(Vector::UnitZ());
  SurfaceHit hit;
  for (int row = 0; row < ambient_.rows; ++row) {
    for (int column = 0; column < ambient_.columns; ++column) {
      const Vector place(ambient_.left + (static_cast<float>(column) + 0.5f) * step,
                         ambient_.low + (static_cast<float>(row) + 0.5f) * step, 0);
      const auto index = static_cast<std::size_t>(row * ambient_.columns + column);
      ambient_.values[index] = Colour::Zero();
      const float away = (place - Vector(centre.x(), centre.y(), 0)).norm() / reach;
      if (away >= 1) continue;
      const Sample* sample = samples.at(column, row);
      Blockers& blocked = blockers[index];
      for (int i = 0; i < count; ++i) {
        const Sample& s = sample[i];
        if (s.choice >= actor.presence()) continue;
        const Ray ray{place, cosineDirection(up, s.diffuseX, s.diffuseY)};
        if (!actor.intersect(ray, s.instant, std::numeric_limits<float>::infinity(), hit)) continue;
        blocked.hits += 1;
        blocked.inverse += 1 / std::max(hit.distance, 1e-5f);
        ambient_.values[index] +=
            roughRadiance(hit, -ray.direction, studio) * 0.6f - studio.softSky(ray.direction);
      }
      ambient_.values[index] *=
          kPi / static_cast<float>(count) * (1 - smoothStep(kFadeFrom, 1, away));
    }
  }
  blur(ambient_, widthsFor(std::move(blockers), ambient_, kAmbientWidth), Colour(Colour::Zero()));
}

Colour roughRadiance(const SurfaceHit& hit, const Vector& towardsEye, const Studio& studio) {
  const Finish& finish = *hit.finish;
  // Nearly black from below: what faces the floor faces its own shadow.
  const float open = 0.35f + 0.65f * smoothStep(-1, 0.3f, hit.normal.z());
  const Colour diffuse = finish.diffuse() / kPi *
                         (studio.ambient(hit.normal) * open + studio.keyIrradiance(hit.normal));
  const Vector mirrored = reflected(towardsEye, hit.normal);
  const Colour around = mirrored.z() > 0 ? studio.softSky(mirrored) : studio.floorRadiance();
  const Colour facing = finish.facing();
  return diffuse + (facing + (1 - facing) * schlick(hit.normal.dot(towardsEye))) * around * open;
}

}  // namespace ifa::render
