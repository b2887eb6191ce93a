// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <gtest/gtest.h>

#include <tuple>

#include "audit/analytic_motion.h"
#include "scenes.h"

namespace ifa::render {
namespace {

constexpr double kStart = 0.25;  // s of the stage at the first contact

/// Named motions of the box, one that tumbles and one that slides far.
Motion motionOf(const std::string& name) {
  const Body box = test::makeDrawableBox();
  return name == "tumbling" ? test::makeTumblingMotion(box) : test::makeSlidingMotion(box);
}
Actor actorOf(const std::string& name) {
  return test::actorOf(test::makeDrawableBox(), motionOf(name), kStart);
}
CameraPath path(CameraKind kind, const std::vector<Actor>& actors, int width = 320,
                int height = 180, const FrameMargins& margins = {}) {
  return {kind, actors, width, height, margins};
}

/// Calls `use(time, centre)` for the body from shortly before its first contact to its end.
template <class Use>
void overMotion(const Actor& actor, const Use& use) {
  const double end = actor.motion->trajectory.back().time;
  for (double time = -0.04; time < end; time += 0.004) {
    use(actor.start + time, actor.poseAt(actor.start + time).position.cast<float>().eval());
  }
}

class Framing : public testing::TestWithParam<std::tuple<const char*, int, int>> {
 protected:
  Actor actor() const { return actorOf(std::get<0>(GetParam())); }
  int width() const { return std::get<1>(GetParam()); }
  int height() const { return std::get<2>(GetParam()); }
};

TEST_P(Framing, FixedCameraShowsTheWholeMotion) {
  const Actor thrown = actor();
  const FrameMargins margins;
  const CameraPath still = path(CameraKind::kFixed, {thrown}, width(), height(), margins);
  EXPECT_TRUE(still.isFixed());
  const Camera camera = still.at(0);
  const auto w = static_cast<float>(width()), h = static_cast<float>(height());
  float left = w, right = 0, top = h, bottom = 0;
  overMotion(thrown, [&](double time, const Vector& centre) {
    EXPECT_TRUE(still.at(time) == camera);
    const Vector seen = camera.project(centre);
    const float radius = thrown.geometry->radius() / camera.pixelAt(seen.z());
    left = std::min(left, seen.x() - radius), right = std::max(right, seen.x() + radius);
    top = std::min(top, seen.y() - radius), bottom = std::max(bottom, seen.y() + radius);
  });
  // A hundredth for balls off the axis, which are seen as ellipses, and for what lies in between.
  EXPECT_GT(left, (margins.side - 0.01f) * w);
  EXPECT_LT(right, (1 - margins.side + 0.01f) * w);
  EXPECT_GT(top, (margins.top - 0.01f) * h);
  EXPECT_LT(bottom, (1 - margins.bottom + 0.01f) * h);
  // ... and no smaller than it must be.
  const bool wide = (right - left) / w > 0.75f, tall = (bottom - top) / h > 0.6f;
  EXPECT_TRUE(wide || tall) << left << ' ' << right << ' ' << top << ' ' << bottom;
}

TEST_P(Framing, FloorFillsThePicture) {
  for (const CameraKind kind : {CameraKind::kFixed, CameraKind::kFollow, CameraKind::kCloseUp}) {
    const CameraPath way = path(kind, {actor()}, width(), height());
    for (const double time : {0.0, 0.4, 0.8}) {
      const Camera camera = way.at(time);
      EXPECT_GT(camera.eye.z(), 0);
      for (const int corner : {0, 1, 2, 3}) {
        const Ray ray = camera.through(static_cast<float>(corner % 2 * width()),
                                       static_cast<float>(corner / 2 * height()));
        EXPECT_LT(ray.direction.z(), -0.1f);
      }
    }
  }
}

TEST_P(Framing, CamerasThatFollowLoseNoContact) {
  const Actor thrown = actor();
  for (const CameraKind kind : {CameraKind::kFollow, CameraKind::kCloseUp}) {
    const CameraPath way = path(kind, {thrown}, width(), height());
    EXPECT_FALSE(way.isFixed());
    for (const MotionContact& contact : thrown.motion->contacts) {
      const double time = contact.time + thrown.start;
      const Vector seen = way.at(time).project(contact.position.cast<float>());
      EXPECT_GT(seen.x(), 0) << contact.time;
      EXPECT_LT(seen.x(), static_cast<float>(width())) << contact.time;
      EXPECT_GT(seen.y(), 0) << contact.time;
      EXPECT_LT(seen.y(), static_cast<float>(height())) << contact.time;
    }
  }
}

TEST_P(Framing, LowCameraSeesTheFloorInOneRowAndTheWholeMotionAboveIt) {
  const Actor thrown = actor();
  const FrameMargins margins;
  const CameraPath still = path(CameraKind::kLow, {thrown}, width(), height(), margins);
  EXPECT_TRUE(still.isFixed());
  const Camera camera = still.at(0);
  EXPECT_GT(camera.eye.z(), 0);
  const auto w = static_cast<float>(width()), h = static_cast<float>(height());
  const float horizon = (1 - margins.bottom) * h;
  float left = w, right = 0, top = h;
  overMotion(thrown, [&](double, const Vector& centre) {
    const Vector below(centre.x(), centre.y(), 0), seen = camera.project(centre);
    EXPECT_GE(camera.project(below).y(), horizon - 0.01f);
    EXPECT_LT(camera.project(below).y(), horizon + 0.004f * h);
    const float reach = thrown.geometry->radius();
    EXPECT_GT(seen.z(), 1.2f * reach);
    left = std::min(left, seen.x() - reach / camera.pixelAt(seen.z()));
    right = std::max(right, seen.x() + reach / camera.pixelAt(seen.z()));
    top = std::min(top, seen.y() - reach / camera.pixelAt(seen.z()));
  });
  EXPECT_GT(left, (margins.side - 0.01f) * w);
  EXPECT_LT(right, (1 - margins.side + 0.01f) * w);
  EXPECT_GT(top, (margins.top - 0.01f) * h);
  const bool wide = (right - left) / w > 0.75f, tall = top / h < 0.2f;
  EXPECT_TRUE(wide || tall) << left << ' ' << right << ' ' << top;
}

INSTANTIATE_TEST_SUITE_P(Motions, Framing,
                         testing::Values(std::make_tuple("tumbling", 320, 180),
                                         std::make_tuple("sliding", 320, 180),
                                         std::make_tuple("tumbling", 90, 160),
                                         std::make_tuple("sliding", 64, 64)));

TEST(Camera, RaysGoThroughWhatIsSeenThere) {
  const Camera camera = path(CameraKind::kFixed, {actorOf("sliding")}).at(0);
  test::Lottery lottery;
  for (int i = 0; i < 200; ++i) {
    const Vector point = camera.eye + camera.forward * static_cast<float>(lottery.between(1, 3)) +
                         0.3f * lottery.direction();
    const Vector seen = camera.project(point);
    const Ray ray = camera.through(seen.x(), seen.y());
    EXPECT_NEAR(ray.direction.norm(), 1, 1e-5);
    const Vector d = point - ray.origin;
    EXPECT_LT((d - d.dot(ray.direction) * ray.direction).norm(), 1e-4f * d.norm());
    EXPECT_NEAR(seen.z(), d.dot(camera.forward), 1e-4);
    // A pixel's width away across the view is a pixel further to the right.
    const Vector beside = camera.project(point + camera.pixelAt(seen.z()) * camera.right);
    EXPECT_NEAR(beside.x() - seen.x(), 1, 1e-2);
  }
}

TEST(Camera, HasNoRollAndKeepsItsDirections) {
  for (const CameraKind kind : {CameraKind::kFixed, CameraKind::kFollow, CameraKind::kCloseUp}) {
    const CameraPath way = path(kind, {actorOf("tumbling")});
    for (const double time : {-1.0, 0.3, 0.9, 50.0}) {
      const Camera camera = way.at(time);
      EXPECT_NEAR(camera.right.z(), 0, 1e-6);
      EXPECT_GT(camera.up.z(), 0.5f);
      EXPECT_NEAR(camera.right.dot(camera.forward), 0, 1e-5);
      EXPECT_LT((camera.right.cross(camera.forward) - camera.up).norm(), 1e-5f);
      EXPECT_NEAR(std::atan2(camera.forward.y(), camera.forward.x()),
                  std::remainder(way.azimuth(), 2 * kPi), 1e-4);
    }
  }
}

TEST(Camera, LowEyeStaysOutsideOfWhatComesTowardsIt) {
  // There and back along y, far more than what is left of it in the end along x.
  Motion motion = test::evenMotion({0, 0, 0.01}, {0, 0, 0});
  for (MotionSample& sample : motion.trajectory) {
    sample.position = {0.02 * sample.time, -std::sin(6.283 * sample.time), 0.01};
  }
  const Actor actor = test::actorOf(test::cubeOf(0.02), motion);
  const Camera camera = path(CameraKind::kLow, {actor}).at(0);
  overMotion(actor, [&](double, const Vector& centre) {
    const Vector seen = camera.project(centre);
    EXPECT_GT(seen.z(), 2 * actor.geometry->radius());
    EXPECT_GT(seen.x(), 0);
    EXPECT_LT(seen.x(), 320);
  });
}

TEST(Camera, SeesTheWayFromLeftToRight) {
  const Body body = test::cubeOf(0.02);
  for (const double angle : {0.0, 1.0, 2.5, 4.0, 5.5}) {
    const Motion motion =
        test::evenMotion({0.1, 0.4, 0.01}, {0.6 * std::cos(angle), 0.6 * std::sin(angle), 0});
    const Camera camera = path(CameraKind::kFixed, {test::actorOf(body, motion)}).at(0);
    const Vector first = camera.project(motion.trajectory.front().position.cast<float>());
    const Vector last = camera.project(motion.trajectory.back().position.cast<float>());
    EXPECT_GT(last.x() - first.x(), 0.6f * 320) << angle;
  }
}

TEST(Camera, LeavesRoomForTheStrip) {
  const Actor thrown = actorOf("tumbling");
  FrameMargins margins;
  margins.bottom += 0.13f;
  const Camera camera = path(CameraKind::kFixed, {thrown}, 320, 180, margins).at(0);
  overMotion(thrown, [&](double, const Vector& centre) {
    const Vector seen = camera.project(centre);
    EXPECT_LT(seen.y() + thrown.geometry->radius() / camera.pixelAt(seen.z()),
              (1 - margins.bottom + 0.01f) * 180);
  });
}

TEST(Camera, FramesAllBodiesThatShareTheFloor) {
  const Body body = test::cubeOf(0.02);
  const std::vector<Actor> actors = {test::actorOf(body, test::restAt({0.4, 0.3, 0.01})),
                                     test::actorOf(body, test::restAt({-0.2, 0, 0.3}))};
  const Camera camera = path(CameraKind::kFixed, actors).at(0);
  for (const Actor& actor : actors) {
    const Vector seen = camera.project(actor.poseAt(0).position.cast<float>());
    EXPECT_GT(seen.x(), 16);
    EXPECT_LT(seen.x(), 304);
    EXPECT_GT(seen.y(), 9);
    EXPECT_LT(seen.y(), 171);
  }
}

TEST(Camera, KeepsAwayFromWhatDoesNotMove) {
  const Camera camera =
      path(CameraKind::kFixed, {test::actorOf(test::cubeOf(0.02), test::restAt({0, 0, 0.01}))})
          .at(0);
  const float distance = camera.project({0, 0, 0.01f}).z();
  const float share = 2 * 0.01f * std::sqrt(3.0f) / (camera.pixelAt(distance) * 180);
  EXPECT_GT(share, 0.2f);
  EXPECT_LT(share, 0.6f);
}

TEST(Camera, CloseUpIsNearerThanFollowing) {
  const Actor thrown = actorOf("sliding");
  const auto distance = [&](CameraKind kind) {
    return path(kind, {thrown}).at(0.5).project(thrown.poseAt(0.5).position.cast<float>()).z();
  };
  EXPECT_LT(distance(CameraKind::kCloseUp), distance(CameraKind::kFollow));
  EXPECT_LT(distance(CameraKind::kCloseUp), distance(CameraKind::kFixed));
}

TEST(Camera, FollowsWithoutJerks) {
  const Actor thrown = actorOf("sliding");
  for (const CameraKind kind : {CameraKind::kFollow, CameraKind::kCloseUp}) {
    const CameraPath way = path(kind, {thrown});
    const double frame = 1 / 60.0;
    for (double time = 0; time < 2; time += frame) {
      const Camera a = way.at(time), b = way.at(time + frame), c = way.at(time + 2 * frame);
      const float distance = a.eye.z() / std::abs(a.forward.z());
      // The body's own change of velocity at a contact would be some metres a second.
      EXPECT_LT((c.eye - 2 * b.eye + a.eye).norm(), 0.02f * distance) << time;
    }
  }
}

}  // namespace
}  // namespace ifa::render
