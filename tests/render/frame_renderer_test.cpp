// SPDX-License-Identifier: Apache-2.0
#include "render/frame_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "audit/analytic_motion.h"
#include "base/parallel.h"
#include "scenes.h"
#include "support/pixels.h"

namespace ifa::render {
namespace {

using test::brightness;
using test::pixelAt;
using test::restAt;

constexpr int kWidth = 128, kHeight = 72;
const std::array<double, 4> kGrey = {0.5, 0.5, 0.5, 1}, kRed = {0.6, 0.05, 0.05, 1};

RenderSettings small(int samples = 16) {
  RenderSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.samplesPerPixel = samples;
  settings.camera = CameraKind::kFixed;
  settings.surface = "carpet";
  return settings;
}

/// Clean pictures: any number of rays.
RenderSettings reference() {
  RenderSettings settings = small(256);
  settings.floorLight.keyRays = settings.floorLight.ambientRays = 64;
  return settings;
}

Actor restingCube(const std::array<double, 4>& colour = kGrey, double start = 0) {
  return test::actorOf(test::cubeOf(0.02, colour), restAt({0, 0, 0.01}), start);
}
/// The same view without the body, which comes later.
Image emptyFloor() { return FrameRenderer({restingCube(kGrey, 100)}, small()).render(0); }

/// Mean brightness of the pixels around the one that shows a point of the world.
double brightnessAt(const Image& image, const Camera& camera, const Vector& point) {
  const Vector seen = camera.project(point);
  const int x = static_cast<int>(seen.x()), y = static_cast<int>(seen.y());
  return test::meanBrightness(image, x - 1, y - 1, x + 2, y + 2);
}

TEST(FrameRenderer, IsTheSameForAnyNumberOfThreads) {
  const Actor thrown =
      test::actorOf(test::makeDrawableBox(), test::makeTumblingMotion(test::makeDrawableBox()));
  const std::vector<double> times = {0.0, 0.1, 0.25, 0.3, 0.5, 0.6};
  std::vector<Image> alone;
  setThreadCount(1);
  {
    const FrameRenderer renderer({thrown}, small());
    for (const double time : times) alone.push_back(renderer.render(time));
  }
  setThreadCount(2);
  const FrameRenderer renderer({thrown}, small());
  std::vector<Image> together(times.size());
  parallelFor(times.size(), [&](std::size_t i) { together[i] = renderer.render(times[i]); });
  setThreadCount(0);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(alone[i].rgb, together[i].rgb) << times[i];
    EXPECT_EQ(alone[i].width, kWidth);
    EXPECT_EQ(alone[i].height, kHeight);
  }
  EXPECT_GT(renderer.rays(), 1000);
}

TEST(FrameRenderer, NothingFlickersAtRest) {
  const FrameRenderer renderer({restingCube(kRed)}, small());
  EXPECT_TRUE(renderer.sameAt(0.1, 0.2));
  EXPECT_TRUE(renderer.sameAt(0.4, 7));
  EXPECT_EQ(renderer.render(0.1).rgb, renderer.render(0.2).rgb);
}

TEST(FrameRenderer, KnowsWhatMoves) {
  const Actor moving =
      test::actorOf(test::cubeOf(0.02, kRed), test::evenMotion({0, 0, 0.01}, {0.2, 0, 0}));
  const FrameRenderer renderer({moving}, small());
  EXPECT_FALSE(renderer.sameAt(0.1, 0.2));
  EXPECT_GT(test::differences(renderer.render(0.1), renderer.render(0.2)), 100);
  // A camera that still goes on makes another picture of a body at rest.
  RenderSettings following = small();
  following.camera = CameraKind::kFollow;
  EXPECT_FALSE(FrameRenderer({moving}, following).sameAt(0.45, 0.55));
}

TEST(FrameRenderer, SlowABodyThatIsNotYetThereLeavesTheFloorEmpty) {
  const Image empty = emptyFloor();
  const Image full = FrameRenderer({restingCube(kRed)}, small()).render(0.1);
  const FrameRenderer late({restingCube(kRed, 1)}, small());
  EXPECT_EQ(late.render(0.5).rgb, empty.rgb);
  EXPECT_EQ(late.render(1.4).rgb, full.rgb);
  const Image half = late.render(1.06);
  const double visible = test::differences(half, empty, 8),
               whole = test::differences(full, empty, 8);
  EXPECT_GT(visible, 0.5 * whole);
  EXPECT_GT(test::differences(half, full, 8), 0.5 * whole);
}

TEST(FrameRenderer, ABodyDarkensTheFloorBesideItAndNothingFarAway) {
  RenderSettings settings = small();
  settings.width = 320, settings.height = 180;
  // A small cube in a wide view: its motion passes by elsewhere.
  Motion motion = test::evenMotion({-0.3, 0, 0.01}, {1.2, 0, 0});
  const Body cube = test::cubeOf(0.02, kGrey);
  const FrameRenderer present({test::actorOf(cube, motion)}, settings);
  const FrameRenderer absent({test::actorOf(cube, motion, 100)}, settings);
  const Image with = present.render(0), without = absent.render(0);
  const Camera camera = present.cameraPath().at(0);
  const Studio studio(present.cameraPath().azimuth(), Colour::Constant(0.2f));
  const Vector key = studio.keyDirection();
  const Vector shadow = Vector(-key.x(), -key.y(), 0).normalized();
  const Vector base(-0.3f, 0, 0);
  const double dark = brightnessAt(with, camera, base + 0.019f * shadow);
  EXPECT_LT(dark, 0.8 * brightnessAt(without, camera, base + 0.019f * shadow));
  int same = 0, all = 0;
  for (int y = 0; y < settings.height; ++y) {
    for (int x = 0; x < settings.width; ++x) {
      const Ray ray = camera.through(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const Vector place = ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
      if ((place - base).norm() < 0.2f) continue;
      ++all;
      same += pixelAt(with, x, y) == pixelAt(without, x, y);
    }
  }
  EXPECT_GT(all, settings.width * settings.height / 4);
  EXPECT_EQ(same, all);
}

TEST(FrameRenderer, ShadowFallsAwayFromTheLight) {
  const FrameRenderer renderer({restingCube()}, small());
  const Image with = renderer.render(0.1), without = emptyFloor();
  const Camera camera = renderer.cameraPath().at(0);
  // The light comes from the left: compare what is lost at both sides.
  const auto lost = [&](const Vector& place) {
    return 1 - brightnessAt(with, camera, place) / brightnessAt(without, camera, place);
  };
  const Vector side = 0.019f * camera.right;
  EXPECT_GT(lost(side), 0.2);
  EXPECT_GT(lost(side), 2 * lost(-side));
}

TEST(FrameRenderer, SlowBodiesHaveTheirColours) {
  const Image empty = emptyFloor();
  const std::array<std::array<double, 4>, 3> colours = {
      {{0.6, 0.05, 0.05, 1}, {0.05, 0.5, 0.05, 1}, {0.05, 0.05, 0.6, 1}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const FrameRenderer renderer({restingCube(colours[k])}, small());
    const Image image = renderer.render(0.1);
    const Vector seen = renderer.cameraPath().at(0).project({0, 0, 0.012f});
    const auto p = pixelAt(image, static_cast<int>(seen.x()), static_cast<int>(seen.y()));
    for (std::size_t other = 0; other < 3; ++other) {
      EXPECT_TRUE(other == k || p[k] > p[other] + 40) << "colour " << k;
    }
    EXPECT_GT(test::differences(image, empty, 40), 100);
  }
}

// A thin plate of the floor's own colour that lies on it looks like the floor: what is traced and
// what is known without rays agree.
TEST(FrameRenderer, APlateOfTheFloorsColourLooksLikeTheFloor) {
  const Colour mean = FloorTexture("carpet").mean();
  const std::array<double, 4> colour = {static_cast<double>(mean.x()),
                                        static_cast<double>(mean.y()),
                                        static_cast<double>(mean.z()), 1};
  const Body plate = test::bodyOf(shapes::box({0.1, 0.1, 0.0005}), colour, 1);
  const Actor here = test::actorOf(plate, restAt({0, 0, 0.00025}));
  const Actor later = test::actorOf(plate, restAt({0, 0, 0.00025}), 100);
  const FrameRenderer renderer({here}, reference());
  const Image with = renderer.render(0.1), without = FrameRenderer({later}, reference()).render(0);
  const Vector seen = renderer.cameraPath().at(0).project({0, 0, 0});
  const int x = static_cast<int>(seen.x()), y = static_cast<int>(seen.y());
  for (std::size_t k = 0; k < 3; ++k) {
    double plateSum = 0, floorSum = 0;
    for (int dy = -5; dy < 5; ++dy) {
      for (int dx = -10; dx < 10; ++dx) {
        const auto linear = [&](const Image& image) {
          return std::pow(pixelAt(image, x + dx, y + dy)[k] / 255.0, 2.2);
        };
        plateSum += linear(with), floorSum += linear(without);
      }
    }
    EXPECT_NEAR(plateSum / floorSum, 1, 0.12) << "colour " << k;
  }
}

TEST(FrameRenderer, NothingIsClipped) {
  for (const double roughness : {0.15, 1.0}) {
    const Image image =
        FrameRenderer({test::actorOf(test::cubeOf(0.02, {0.93, 0.9, 0.82, 1}, roughness),
                                     restAt({0, 0, 0.01}))},
                      small())
            .render(0.1);
    int white = 0;
    for (int i = 0; i < kWidth * kHeight; ++i)
      white += brightness(image, i % kWidth, i / kWidth) == 765;
    EXPECT_LT(white, kWidth * kHeight / 200) << roughness;
  }
}

TEST(FrameRenderer, HasNoFireflies) {
  RenderSettings settings = small();
  settings.width = 192, settings.height = 108;
  Motion askew = restAt({0, 0, 0.018});
  for (auto& sample : askew.trajectory) {
    sample.orientation = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized();
  }
  const Body ball = test::bodyOf(shapes::sphere(0.016, 16), kRed, 0.7);
  const Image image = FrameRenderer({test::actorOf(test::cubeOf(0.02, kRed), askew),
                                     test::actorOf(ball, restAt({0.03, 0.02, 0.016}))},
                                    settings)
                          .render(0.1);
  for (int y = 1; y + 1 < settings.height; ++y) {
    for (int x = 1; x + 1 < settings.width; ++x) {
      int brightest = 0;
      for (int i = 0; i < 9; ++i) {
        if (i != 4)
          brightest = std::max(brightest, brightness(image, x - 1 + i % 3, y - 1 + i / 3));
      }
      ASSERT_LT(brightness(image, x, y) - brightest, 75) << x << ", " << y;
    }
  }
}

TEST(FrameRenderer, SlowDraftIsCloseToAnyNumberOfRays) {
  const Body box = test::makeDrawableBox();
  const Actor thrown = test::actorOf(box, test::makeTumblingMotion(box));
  const FrameRenderer draft({thrown}, small()), many({thrown}, reference());
  for (const double time : {0.05, 0.3}) {
    EXPECT_GT(test::psnr(draft.render(time), many.render(time)), 35) << time;
  }
  const FrameRenderer still({restingCube(kRed)}, small()), clean({restingCube(kRed)}, reference());
  EXPECT_GT(test::psnr(still.render(0.1), clean.render(0.1)), 33);
}

TEST(FrameRenderer, SlowAWiderShutterBlursMore) {
  const Actor moving =
      test::actorOf(test::cubeOf(0.02, kRed), test::evenMotion({-0.1, 0, 0.05}, {2, 0, 0}, 0.1));
  const Actor later = test::actorOf(test::cubeOf(0.02, kRed),
                                    test::evenMotion({-0.1, 0, 0.05}, {2, 0, 0}, 0.1), 100);
  const Image without = FrameRenderer({later}, small()).render(0.05);
  // Pixels that the body makes redder.
  const auto touched = [&](double shutter) {
    RenderSettings settings = small(64);
    settings.shutterSeconds = shutter;
    const Image with = FrameRenderer({moving}, settings).render(0.05);
    int count = 0;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      const auto p = pixelAt(with, i % kWidth, i / kWidth);
      const auto q = pixelAt(without, i % kWidth, i / kWidth);
      count += p[0] - p[2] > q[0] - q[2] + 15;
    }
    return count;
  };
  const int sharp = touched(0), some = touched(0.005), much = touched(0.015);
  EXPECT_GT(sharp, 40);
  EXPECT_GT(some, 1.2 * sharp);
  EXPECT_GT(much, 1.3 * some);
  // 2 m/s for 15 ms: 30 mm beside the cube's 20.
  EXPECT_LT(much, 4 * sharp);
}

// The shortcut for bodies that cannot shade themselves changes nothing: for a hull that reaches
// further than what is seen it is not taken.
TEST(FrameRenderer, ConvexBodiesAreDrawnAsAnyOther) {
  Motion askew = restAt({0, 0, 0.02});
  for (auto& sample : askew.trajectory) {
    sample.orientation = Eigen::Quaterniond(0.8, 0.3, -0.2, 0.4).normalized();
  }
  Body box = test::bodyOf(shapes::box({0.02, 0.02, 0.02}), kGrey, 0.5);
  const Image shortcut = FrameRenderer({test::actorOf(box, askew)}, small()).render(0.1);
  for (const int sign : {-1, 1}) {
    for (int axis = 0; axis < 3; ++axis) box.hull.emplace_back(sign * Eigen::Vector3d::Unit(axis));
  }
  const Image traced = FrameRenderer({test::actorOf(box, askew)}, small()).render(0.1);
  EXPECT_GT(test::psnr(shortcut, traced), 45);
}

TEST(FrameRenderer, ABodyShadesAnother) {
  const Body large = test::cubeOf(0.04, kGrey), little = test::cubeOf(0.01, kGrey);
  const Actor cube = test::actorOf(large, restAt({0, 0, 0.02}));
  Studio studio(0, Colour::Zero());
  {
    const CameraPath path(CameraKind::kFixed, {cube}, kWidth, kHeight, {});
    studio = Studio(path.azimuth(), Colour::Constant(0.2f));
  }
  const Vector away =
      Vector(-studio.keyDirection().x(), -studio.keyDirection().y(), 0).normalized();
  const Eigen::Vector3d place = (0.032 * away.cast<double>()) + Eigen::Vector3d(0, 0, 0.005);
  const Actor shaded = test::actorOf(little, restAt(place));
  const Actor shading = test::actorOf(large, restAt({0, 0, 0.02}), 100);
  const FrameRenderer both({cube, shaded}, small()), alone({shading, shaded}, small());
  const Camera camera = both.cameraPath().at(0);
  ASSERT_TRUE(camera == alone.cameraPath().at(0));
  const Vector top = place.cast<float>() + Vector(0, 0, 0.005f);
  EXPECT_LT(brightnessAt(both.render(0.1), camera, top),
            0.75 * brightnessAt(alone.render(0.1), camera, top));
}

TEST(FrameRenderer, AGlossyFloorMirrors) {
  RenderSettings settings = small();
  settings.surface = "desk";
  const Body red = test::cubeOf(0.02, {0.9, 0.02, 0.02, 1});
  const auto redness = [&](double height) {
    const FrameRenderer renderer({test::actorOf(red, restAt({0, 0, height}))}, settings);
    const Image image = renderer.render(0.1);
    // In front of the cube's lower edge, where a mirror would show its face.
    const Camera camera = renderer.cameraPath().at(0);
    const Vector near = -Vector(camera.forward.x(), camera.forward.y(), 0).normalized();
    const Vector seen = camera.project(0.02f * near);
    const auto p = pixelAt(image, static_cast<int>(seen.x()), static_cast<int>(seen.y()));
    return static_cast<double>(p[0]) / std::max(1, p[2]);
  };
  EXPECT_GT(redness(0.01), 1.0);
}

/// Lowest row above `end` in which the pictures differ clearly, or -1.
int lowestDifference(const Image& a, const Image& b, int end) {
  for (int y = end - 1; y >= 0; --y) {
    for (int x = 0; x < a.width; ++x) {
      if (std::abs(brightness(a, x, y) - brightness(b, x, y)) > 12) return y;
    }
  }
  return -1;
}

TEST(FrameRenderer, ALowCameraShowsHowHighTheLowestPointIs) {
  RenderSettings settings = small();
  settings.camera = CameraKind::kLow;
  settings.width = 320, settings.height = 180;
  settings.shutterSeconds = 0;
  const Motion motion = test::evenMotion({0.03, 0.02, 0.01}, {0.05, 0, 0.1});
  for (const auto& colour : {kGrey, kRed, std::array<double, 4>{0.9, 0.88, 0.8, 1}}) {
    const Body cube = test::cubeOf(0.02, colour);
    const FrameRenderer renderer({test::actorOf(cube, motion)}, settings);
    const Image empty = FrameRenderer({test::actorOf(cube, motion, 100)}, settings).render(0);
    const Camera camera = renderer.cameraPath().at(0);
    const int horizon = static_cast<int>(camera.project({0.03f, 0.02f, 0}).y());
    for (const double time : {0.0, 0.04, 0.1, 0.2, 0.4}) {
      float lowest = 0;
      for (const Eigen::Vector3d& vertex : cube.mesh.vertices) {
        const Eigen::Vector3d place =
            motion.trajectory.front().position + time * Eigen::Vector3d(0.05, 0, 0.1) + vertex;
        lowest = std::max(lowest, camera.project(place.cast<float>()).y());
      }
      const int row = lowestDifference(renderer.render(time), empty, horizon);
      EXPECT_NEAR(row + 1, std::min(lowest, static_cast<float>(horizon)), 1) << time;
    }
  }
}

TEST(FrameRenderer, ALowCameraSeesABackdropAndTheFloorBelowIt) {
  RenderSettings settings = small();
  settings.camera = CameraKind::kLow;
  for (const char* surface : {"desk", "wood", "carpet"}) {
    settings.surface = surface;
    const FrameRenderer renderer({restingCube(kGrey, 100)}, settings);
    const Image empty = renderer.render(0);
    const float horizon = renderer.cameraPath().at(0).project({0, 0, 0}).y();
    const int above = static_cast<int>(horizon) - 1, below = above + 3;
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_GT(brightness(empty, x, above), brightness(empty, x, below) + 60) << surface;
      EXPECT_LT(std::abs(brightness(empty, x, above) - brightness(empty, 0, above)), 6) << surface;
    }
  }
}

TEST(FrameRenderer, CamerasThatMoveDrawTheFloorAnew) {
  RenderSettings settings = small();
  settings.camera = CameraKind::kCloseUp;
  const Actor moving =
      test::actorOf(test::cubeOf(0.02, kRed), test::evenMotion({-0.3, 0, 0.01}, {1.2, 0, 0}));
  const FrameRenderer renderer({moving}, settings);
  const Image early = renderer.render(0.1), late = renderer.render(0.4);
  EXPECT_GT(test::differences(early, late), kWidth * kHeight / 3);
  for (const double time : {0.1, 0.4}) {
    const Vector seen =
        renderer.cameraPath().at(time).project(moving.poseAt(time).position.cast<float>());
    const auto p =
        pixelAt(time < 0.2 ? early : late, static_cast<int>(seen.x()), static_cast<int>(seen.y()));
    EXPECT_GT(p[0], p[2] + 40);
  }
}

}  // namespace
}  // namespace ifa::render
