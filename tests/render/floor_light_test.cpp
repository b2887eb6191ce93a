// SPDX-License-Identifier: Apache-2.0
#include "render/floor_light.h"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.h"

namespace ifa::render {
namespace {

constexpr float kRadius = 0.01f;

const Studio& studio() {
  static const Studio kStudio(0.9f, Colour(0.25f, 0.2f, 0.15f));
  return kStudio;
}
const SampleTable& samples() {
  static const SampleTable kSamples(256);
  return kSamples;
}
/// A black ball: what it takes from the floor it does not give back.
const Body& ball() {
  static const Body kBall = test::bodyOf(shapes::sphere(kRadius, 40), {0, 0, 0, 1});
  return kBall;
}

FloorLightSettings converged() {
  FloorLightSettings settings;
  settings.keyRays = 64;
  settings.ambientRays = 64;
  settings.keyFineness = 20;
  settings.ambientFineness = 8;
  settings.pixel = 0;
  return settings;
}

/// The light about a body that stands still.
struct Scene {
  Scene(const Body& body, const Motion& motion, const FloorLightSettings& settings,
        double start = 0, double time = 0.1)
      : actor(test::actorOf(body, motion, start)),
        moment(actor, time, time),
        light(moment, studio(), samples(), settings) {}
  Actor actor;
  ActorMoment moment;
  FloorLight light;
};

Scene ballAt(float height, const FloorLightSettings& settings = converged()) {
  return {ball(), test::restAt({0, 0, height}), settings};
}

bool meetsBall(const Vector& place, const Vector& d, float height) {
  const Vector towards = Vector(0, 0, height) - place;
  const float along = towards.dot(d);
  return along > 0 && towards.squaredNorm() - along * along < kRadius * kRadius;
}

/// Share of the key light that a ball lets through to the floor, from geometry alone.
float keyPast(float x, float y, float height) {
  constexpr int kSide = 48;
  int open = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vector d = studio().towardsKey((static_cast<float>(i % kSide) + 0.5f) / kSide,
                                         (static_cast<float>(i / kSide) + 0.5f) / kSide);
    open += meetsBall({x, y, 0}, d, height) ? 0 : 1;
  }
  return static_cast<float>(open) / (kSide * kSide);
}

/// Where the middle of the key light throws the middle of a ball's shadow.
Vector shadowOf(float height) {
  const Vector& towards = studio().keyDirection();
  return {-height * towards.x() / towards.z(), -height * towards.y() / towards.z(), 0};
}

class BallAt : public testing::TestWithParam<float> {
 protected:
  float height() const { return GetParam() * kRadius; }
};

TEST_P(BallAt, ThrowsTheShadowThatGeometryAsksFor) {
  const Scene scene = ballAt(height());
  const Vector middle = shadowOf(height());
  const Vector away = middle.norm() > 0 ? Vector(middle.normalized()) : Vector(Vector::UnitX());
  for (float place = -4; place <= 4; place += 0.25f) {
    const Vector along = middle + place * kRadius * away;
    const Vector across = middle + place * kRadius * Vector(-away.y(), away.x(), 0);
    for (const Vector& p : {along, across}) {
      EXPECT_NEAR(scene.light.key(p.x(), p.y()), keyPast(p.x(), p.y(), height()), 0.1f)
          << place << " radii from the middle";
    }
  }
}

TEST_P(BallAt, TakesAsMuchLightAsItCatches) {
  const Scene scene = ballAt(height());
  const auto& grid = scene.light.keyGrid();
  double area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double dark =
          1 -
          static_cast<double>(grid.values[static_cast<std::size_t>(row * grid.columns + column)]);
      area += dark;
      moment += dark * Eigen::Vector2d(grid.left + (column + 0.5) * grid.step,
                                       grid.low + (row + 0.5) * grid.step);
    }
  }
  const double step = grid.step;
  // Each direction of the light throws an ellipse of this area.
  double expected = 0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d d = studio()
                                  .towardsKey((static_cast<float>(i % 20) + 0.5f) / 20,
                                              (static_cast<float>(i / 20) + 0.5f) / 20)
                                  .cast<double>();
    const double ellipse = 3.14159265 * kRadius * kRadius / d.z() / 400;
    expected += ellipse;
    middle -= ellipse * height() / d.z() * d.head<2>();
  }
  EXPECT_NEAR(area * step * step, expected, 0.03 * expected);
  EXPECT_LT((moment / area - middle / expected).norm(), 0.08 * kRadius);
}

INSTANTIATE_TEST_SUITE_P(Heights, BallAt, testing::Values(1.0f, 2.0f, 4.0f, 12.0f));

// Irradiance below a ball whose middle is h above: the cosine-weighted share of the sky that it
// hides is (r/h)^2.
TEST(FloorLight, HidesTheSkysShareThatABallCovers) {
  for (const float height : {1.5f, 2.0f, 3.0f, 5.0f}) {
    const Scene scene = ballAt(height * kRadius);
    Colour hidden = Colour::Zero(), whole = Colour::Zero();
    test::overHemisphere(96, [&](const Vector& d, float solid) {
      whole += studio().softSky(d) * d.z() * solid;
      if (meetsBall({0, 0, 0}, d, height * kRadius)) hidden += studio().softSky(d) * d.z() * solid;
    });
    // The sky is brighter above, so that what is hidden there weighs more than its share.
    EXPECT_NEAR((hidden / whole).mean(), 1 / (height * height), 0.35f / (height * height));
    const Colour found = -scene.light.ambient(0, 0);
    EXPECT_NEAR(found.mean(), hidden.mean(), 0.08f * hidden.mean()) << height << " radii high";
  }
}

TEST(FloorLight, HidesLessOfTheSkyFurtherAway) {
  const float height = 2 * kRadius;
  const Scene scene = ballAt(height);
  for (const float x : {0.5f, 1.0f, 2.0f, 3.0f}) {
    Colour hidden = Colour::Zero();
    const Vector place(0.6f * x * kRadius, -0.8f * x * kRadius, 0);
    test::overHemisphere(96, [&](const Vector& d, float solid) {
      if (meetsBall(place, d, height)) hidden += studio().softSky(d) * d.z() * solid;
    });
    const Colour deepest = -scene.light.ambient(0, 0);
    EXPECT_NEAR(-scene.light.ambient(place.x(), place.y()).mean(), hidden.mean(),
                0.06f * deepest.mean())
        << x << " radii away";
  }
}

TEST(FloorLight, IsUntouchedFarAway) {
  const Scene scene = ballAt(2 * kRadius);
  for (const Vector& far : {Vector(0.5f, 0, 0), Vector(-0.5f, 0.5f, 0), Vector(0, -9, 0)}) {
    EXPECT_EQ(scene.light.key(far.x(), far.y()), 1);
    EXPECT_TRUE((scene.light.ambient(far.x(), far.y()) == 0).all());
  }
  // Where the grids end, nothing is left of the shadow: no edge is seen.
  const auto& key = scene.light.keyGrid();
  const auto& sky = scene.light.ambientGrid();
  for (int i = 0; i < key.columns; ++i) {
    EXPECT_EQ(key.values[static_cast<std::size_t>(i)], 1);
    EXPECT_EQ(key.values[static_cast<std::size_t>((key.rows - 1) * key.columns + i)], 1);
    EXPECT_EQ(key.values[static_cast<std::size_t>(i * key.columns)], 1);
  }
  for (int i = 0; i < sky.columns; ++i) {
    EXPECT_LT(sky.values[static_cast<std::size_t>(i)].abs().maxCoeff(), 0.01f);
    EXPECT_LT(sky.values[static_cast<std::size_t>(i * sky.columns)].abs().maxCoeff(), 0.01f);
  }
}

TEST(FloorLight, IsDarkUnderABoxThatStandsThere) {
  const Scene scene(test::cubeOf(0.02, {0.5, 0.5, 0.5, 1}), test::restAt({0.1, 0.2, 0.01}),
                    converged());
  EXPECT_NEAR(scene.light.key(0.1f, 0.2f), 0, 1e-3);
  const float sky = studio().skyOnFloor().mean();
  EXPECT_LT(scene.light.ambient(0.1f, 0.2f).mean(), -0.65f * sky);
  // Just beside it half of the sky is hidden at most; a side's length away much less.
  const float near = scene.light.ambient(0.112f, 0.2f).mean();
  EXPECT_LT(near, -0.05f * sky);
  EXPECT_GT(near, -0.7f * sky);
  EXPECT_GT(scene.light.ambient(0.135f, 0.2f).mean(), 0.3f * near);
}

TEST(FloorLight, ShadowsAreSharpAtAContactOnly) {
  // Width over which the shadow goes from a tenth to nine tenths.
  const auto softness = [](float height) {
    FloorLightSettings settings = converged();
    settings.keyFineness = 60;
    const Scene scene(test::bodyOf(shapes::box({0.02, 0.02, 0.001}), {0, 0, 0, 1}),
                      test::restAt({0, 0, height}), settings);
    const Vector middle = shadowOf(height);
    int soft = 0;
    for (int i = 0; i < 4000; ++i) {
      const float x = middle.x() + 1e-5f * static_cast<float>(i);
      const float key = scene.light.key(x, middle.y());
      if (key > 0.1f && key < 0.9f) ++soft;
    }
    return 1e-5f * static_cast<float>(soft);
  };
  const float contact = softness(0.0005f), low = softness(0.01f), high = softness(0.03f);
  EXPECT_LT(contact, 0.0015f);
  EXPECT_GT(low, 2 * contact);
  EXPECT_GT(high, 2 * low);
}

TEST(FloorLight, ABrightBodyGivesLightBack) {
  const float height = 2 * kRadius;
  const Body white = test::bodyOf(shapes::sphere(kRadius, 24), {0.9, 0.9, 0.9, 1});
  const Body red = test::bodyOf(shapes::sphere(kRadius, 24), {0.9, 0.05, 0.05, 1});
  const Motion motion = test::restAt({0, 0, height});
  const Colour black = ballAt(height).light.ambient(0, 0);
  const Colour fromWhite = Scene(white, motion, converged()).light.ambient(0, 0);
  const Colour fromRed = Scene(red, motion, converged()).light.ambient(0, 0);
  EXPECT_GT((fromWhite - black).minCoeff(), 0.02f);
  EXPECT_LT(fromWhite.maxCoeff(), 0) << "but less than it takes";
  EXPECT_GT(fromRed.x() - black.x(), 3 * (fromRed.y() - black.y())) << "colour bleeds";
}

TEST(FloorLight, FadesInWithTheBody) {
  const Motion motion = test::restAt({0, 0, 2 * kRadius});
  const Vector middle = shadowOf(2 * kRadius);
  const Scene absent(ball(), motion, converged(), 1, 0.5);
  EXPECT_EQ(absent.light.key(middle.x(), middle.y()), 1);
  EXPECT_TRUE((absent.light.ambient(0, 0) == 0).all());
  const Actor actor = test::actorOf(ball(), motion, 1);
  const ActorMoment moment(actor, 1.06, 1.06);
  const FloorLight half(moment, studio(), samples(), converged());
  EXPECT_NEAR(half.key(middle.x(), middle.y()), 1 - moment.presence(), 0.05f);
}

TEST(FloorLight, IsAveragedOverTheShuttersOpening) {
  // A ball that passes over a place in a tenth of the opening darkens it for that long.
  const double speed = 4, opening = 0.05;
  const Actor actor = test::actorOf(ball(), test::evenMotion({-0.2, 0, kRadius}, {speed, 0, 0}));
  const ActorMoment moment(actor, 0.05 - opening / 2, 0.05 + opening / 2);
  const FloorLight light(moment, studio(), samples(), converged());
  const Vector middle = shadowOf(kRadius);
  const float chord = 2 * kRadius / studio().keyDirection().z();  // about, along the way
  const float share = 1 - light.key(middle.x(), middle.y());
  EXPECT_GT(share, 0.5f * 2 * kRadius / static_cast<float>(speed * opening));
  EXPECT_LT(share, 1.5f * chord / static_cast<float>(speed * opening));
}

// A draft looks like what any number of rays would give.
TEST(FloorLight, DraftIsFreeOfNoise) {
  FloorLightSettings draft, many;
  many.keyRays = many.ambientRays = 128;
  draft.keyFineness = many.keyFineness = 32;
  draft.ambientFineness = many.ambientFineness = 12;
  const Body die = test::cubeOf(0.016, {0.7, 0.1, 0.1, 1});
  for (const double height : {0.008, 0.02, 0.06}) {
    Motion motion = test::restAt({0, 0, height});
    for (auto& sample : motion.trajectory) {
      if (height > 0.01) sample.orientation = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized();
    }
    const Scene few(die, motion, draft), all(die, motion, many);
    double key = 0, sky = 0;
    int count = 0;
    for (double x = -0.1; x < 0.1; x += 0.0011) {
      for (double y = -0.1; y < 0.1; y += 0.0011) {
        const auto px = static_cast<float>(x), py = static_cast<float>(y);
        if (all.light.key(px, py) == 1 && all.light.ambient(px, py).x() == 0) continue;
        const double k = few.light.key(px, py) - all.light.key(px, py);
        const double s = (few.light.ambient(px, py) - all.light.ambient(px, py)).mean() /
                         studio().skyOnFloor().mean();
        key += k * k, sky += s * s, ++count;
      }
    }
    EXPECT_LT(std::sqrt(key / count), 0.03) << height;
    EXPECT_LT(std::sqrt(sky / count), 0.015) << height;
  }
}

TEST(FloorLight, DoesNotShimmerWhereTheBodyRests) {
  const Scene first(ball(), test::restAt({0, 0, kRadius}), converged(), 0, 0.1);
  const Scene second(ball(), test::restAt({0, 0, kRadius}), converged(), 0, 0.2);
  EXPECT_EQ(first.light.keyGrid().values, second.light.keyGrid().values);
}

}  // namespace
}  // namespace ifa::render
