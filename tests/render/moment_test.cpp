// SPDX-License-Identifier: Apache-2.0
#include "render/moment.h"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.h"

namespace ifa::render {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

/// Stands askew in the world and does not move.
Motion askew() {
  Motion motion = test::restAt({0.3, -0.2, 0.05});
  for (MotionSample& sample : motion.trajectory) {
    sample.orientation = Eigen::Quaterniond(0.5, -0.1, 0.7, 0.3).normalized();
  }
  return motion;
}

TEST(Moment, TracesInTheWorldsFrame) {
  const Body body = test::bodyOf(shapes::box({0.02, 0.03, 0.01}));
  const Motion motion = askew();
  const Actor actor = test::actorOf(body, motion);
  const Moment moment({actor}, 0.1, 0.01);
  const Eigen::Matrix3f turn =
      motion.trajectory.front().orientation.toRotationMatrix().cast<float>();
  const Vector place = motion.trajectory.front().position.cast<float>();
  test::Lottery lottery;
  SurfaceHit found, expected;
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector origin = place + lottery.direction() * static_cast<float>(lottery.between(0, 0.1));
    const Vector target =
        place + lottery.direction() * static_cast<float>(lottery.between(0, 0.02));
    const Ray ray{origin, (target - origin).normalized()};
    const Ray local{turn.transpose() * (origin - place), turn.transpose() * ray.direction};
    const int instant = i % kInstants;
    const bool wanted = actor.geometry->intersect(local, kFar, expected);
    ASSERT_EQ(moment.intersect(ray, instant, 0.5f, found), wanted ? 0 : Moment::kNobody) << i;
    ASSERT_EQ(moment.occluded(ray, instant, 0.5f, Moment::kNobody), wanted) << i;
    // Without the only body there is nothing.
    ASSERT_FALSE(moment.occluded(ray, instant, 0.5f, 0));
    ASSERT_EQ(moment.intersect(ray, instant, 0.5f, found, 0), Moment::kNobody);
    if (!wanted) continue;
    ++hits;
    ASSERT_EQ(moment.intersect(ray, instant, 0.5f, found), 0u);
    ASSERT_NEAR(found.distance, expected.distance, 1e-6);
    ASSERT_EQ(found.distance, moment.actors().front().distance(ray, instant));
    ASSERT_LT((turn.transpose() * found.normal - expected.normal).norm(), 1e-4f);
    ASSERT_LT((turn.transpose() * found.geometric - expected.geometric).norm(), 1e-4f);
  }
  EXPECT_GT(hits, 500);
}

TEST(Moment, FindsTheNearestOfSeveral) {
  const Body body = test::cubeOf(0.02);
  const std::vector<Actor> actors = {test::actorOf(body, test::restAt({0.1, 0, 0.01})),
                                     test::actorOf(body, test::restAt({0, 0, 0.01})),
                                     test::actorOf(body, test::restAt({0.2, 0, 0.01}))};
  const Moment moment(actors, 0, 0);
  SurfaceHit hit;
  EXPECT_EQ(moment.intersect({{-1, 0, 0.01f}, Vector::UnitX()}, 0, 0, hit), 1u);
  EXPECT_NEAR(hit.distance, 0.99, 1e-5);
  EXPECT_EQ(moment.intersect({{1, 0, 0.01f}, -Vector::UnitX()}, 0, 0, hit), 2u);
  EXPECT_NEAR(hit.distance, 0.79, 1e-5);
  EXPECT_EQ(moment.intersect({{1, 0, 0.01f}, -Vector::UnitX()}, 0, 0, hit, 2), 0u);
  EXPECT_EQ(moment.intersect({{1, 0, 0.05f}, -Vector::UnitX()}, 0, 0, hit), Moment::kNobody);
  EXPECT_TRUE(moment.occluded({{1, 0, 0.01f}, -Vector::UnitX()}, 0, 0, 1));
}

TEST(Moment, BodiesMoveWhileTheShutterIsOpen) {
  const double speed = 2, opening = 0.01;
  const Actor actor =
      test::actorOf(test::cubeOf(0.02), test::evenMotion({0, 0, 0.1}, {speed, 0, 0}));
  const Moment moment({actor}, 0.1, opening);
  SurfaceHit hit;
  float last = 0;
  for (int instant = 0; instant < kInstants; ++instant) {
    ASSERT_EQ(moment.intersect({{-1, 0, 0.1f}, Vector::UnitX()}, instant, 0, hit), 0u);
    const double time = 0.1 + opening * ((instant + 0.5) / kInstants - 0.5);
    EXPECT_NEAR(hit.distance, 1 - 0.01 + speed * time, 1e-5) << instant;
    EXPECT_GT(hit.distance, last);
    last = hit.distance;
  }
  const ActorMoment& placed = moment.actors().front();
  EXPECT_NEAR(placed.centre().x(), speed * 0.1, 1e-5);
  EXPECT_NEAR(placed.lowest(), 0.1, 1e-6);
  EXPECT_NEAR(placed.sweep(), speed * opening, 0.02 * speed * opening);
  for (int instant = 0; instant < kInstants; ++instant) {
    EXPECT_LE((placed.at(instant).position - placed.centre()).norm() + placed.radius(),
              placed.reach() + 1e-6f);
  }
}

TEST(Moment, HoldsThePoseBeforeAndAfterTheMotion) {
  const Actor actor =
      test::actorOf(test::cubeOf(0.02), test::evenMotion({0, 0, 0.1}, {1, 0, 0}, 0.5), 2);
  EXPECT_NEAR(actor.poseAt(1).position.x(), 0, 1e-12);
  EXPECT_NEAR(actor.poseAt(2.25).position.x(), 0.25, 1e-9);
  EXPECT_NEAR(actor.poseAt(9).position.x(), 0.5, 1e-12);
}

TEST(Moment, OffsetMovesTheBody) {
  Actor actor = test::actorOf(test::cubeOf(0.02), test::restAt({0, 0, 0.01}));
  actor.offset = {0, 0.3, 0};
  SurfaceHit hit;
  const Moment moment({actor}, 0, 0);
  EXPECT_EQ(moment.intersect({{0, 0.3f, 1}, -Vector::UnitZ()}, 0, 0, hit), 0u);
  EXPECT_EQ(moment.intersect({{0, 0, 1}, -Vector::UnitZ()}, 0, 0, hit), Moment::kNobody);
}

TEST(Moment, ABodyFadesInWhereItsMotionBeginsAfterTheFilm) {
  const Motion motion = test::restAt({0, 0, 0.01});
  const Actor late = test::actorOf(test::cubeOf(0.02), motion, 1);
  EXPECT_EQ(late.presenceAt(0.5), 0);
  EXPECT_EQ(late.presenceAt(1), 0);
  EXPECT_GT(late.presenceAt(1.05), late.presenceAt(1.02));
  EXPECT_EQ(late.presenceAt(1.5), 1);
  EXPECT_EQ(test::actorOf(test::cubeOf(0.02), motion).presenceAt(0), 1) << "there from the start";

  const Moment moment({late}, 1.06, 0);
  const float presence = moment.actors().front().presence();
  ASSERT_GT(presence, 0.2f);
  ASSERT_LT(presence, 0.8f);
  const Ray ray{{0, 0, 1}, -Vector::UnitZ()};
  SurfaceHit hit;
  for (const float choice : {0.0f, 0.5f * presence, presence - 1e-4f}) {
    EXPECT_EQ(moment.intersect(ray, 0, choice, hit), 0u);
    EXPECT_TRUE(moment.occluded(ray, 0, choice, Moment::kNobody));
  }
  for (const float choice : {presence, 0.999f}) {
    EXPECT_EQ(moment.intersect(ray, 0, choice, hit), Moment::kNobody);
    EXPECT_FALSE(moment.occluded(ray, 0, choice, Moment::kNobody));
  }
}

TEST(Moment, IsTheSameOnlyAtRest) {
  const Body body = test::cubeOf(0.02);
  const std::vector<Actor> resting = {test::actorOf(body, test::restAt({0, 0, 0.01}))};
  const std::vector<Actor> moving = {
      test::actorOf(body, test::evenMotion({0, 0, 0.01}, {0.1, 0, 0}))};
  EXPECT_TRUE(Moment(resting, 0.1, 0.01).sameAs(Moment(resting, 0.3, 0.01)));
  EXPECT_FALSE(Moment(moving, 0.1, 0.01).sameAs(Moment(moving, 0.3, 0.01)));
  EXPECT_FALSE(Moment(moving, 0.1, 0.01).sameAs(Moment(moving, 0.1, 0.01)));
  EXPECT_TRUE(Moment(moving, 0.8, 0.01).sameAs(Moment(moving, 1.2, 0.01))) << "held at the end";
  EXPECT_FALSE(Moment(resting, 0, 0).sameAs(Moment({}, 0, 0)));
  const std::vector<Actor> late = {test::actorOf(body, test::restAt({0, 0, 0.01}), 1)};
  EXPECT_FALSE(Moment(late, 1.03, 0).sameAs(Moment(late, 1.06, 0))) << "it fades in";
}

}  // namespace
}  // namespace ifa::render
